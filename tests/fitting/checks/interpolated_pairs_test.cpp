// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/interpolated_pairs.hpp"

#include <random>

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// One random direction pair in every cell of a grid of 5° in both zenith angles and 10° in azimuth: no exact partner anywhere.
std::vector<GonioAngles> random_in_cells(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<GonioAngles> out;
  for (double i = 5; i < 75; i += 5)
    for (double o = 5; o < 75; o += 5)
      for (double phi = 0; phi < 360; phi += 10) {
        const double turn = 360 * uniform(random);
        out.push_back({degrees(i + 5 * uniform(random)), degrees(turn), degrees(o + 5 * uniform(random)),
                       degrees(turn + phi + 10 * uniform(random))});
      }
  return out;
}

Check scattered(double s, double asymmetry, unsigned seed) {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, s);
  auto data = readings(truth, random_in_cells(seed), percent, seed + 100);
  for (std::size_t k = 0; k < data->size(); ++k)
    data->f[0][k] *= 1 + asymmetry * (data->angles[k].theta_i.cos() - data->angles[k].theta_o.cos());
  return run(check_reciprocity, data);
}

}  // namespace

TEST_CASE("Reciprocal scattered data have χ²/n of one, at s = 10 and 100, and are not refused") {
  for (const double s : {10., 100.})
    for (const unsigned seed : {1u, 2u}) {
      const Check check = scattered(s, 0, seed);
      INFO("s " << s << ", seed " << seed << ": " << check.detail);
      CHECK(check.n > 5000);
      CHECK(*check.statistic / static_cast<double>(check.n) > 0.9);
      CHECK(*check.statistic / static_cast<double>(check.n) < 1.1);
      CHECK(*check.p_value > 0.001);
      CHECK(check.verdict == Verdict::pass);
      CHECK(check.detail.find("interpolation") != std::string::npos);
    }
}

TEST_CASE("Scattered data with an asymmetry of 10 % fail, and it is found to go with the cosines") {
  const Check check = scattered(100, .05, 3);
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(check.detail.find("cosines") != std::string::npos);
}

TEST_CASE("The directed tests of scattered data keep their size, because shared samples are accounted for") {
  int refused_at_5_percent = 0, tests = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::vector<GonioAngles> few = random_in_cells(seed);
    few.resize(2500);
    const Check check = run(check_reciprocity, sweep(few, percent, seed));
    for (const DirectedTest& test : check.directed) ++tests, refused_at_5_percent += test.p_value < 0.05;
  }
  INFO(refused_at_5_percent << " of " << tests);
  CHECK(tests >= 120);
  // Three standard deviations of a proportion of 5 %.
  CHECK(refused_at_5_percent <= .05 * tests + 3 * std::sqrt(.05 * .95 * tests));
}

TEST_CASE("A dense grid of few incidences knows what it cannot interpolate: reciprocal data with a misfitting model do not fail") {
  // No Blinn-Phong lobe: the ratio to the fit is not smooth between incidences 15° apart.
  const auto truth = [](const GonioAngles& a) {
    const double t = a.theta_i.cos() * a.theta_o.cos();
    return 1 + 2 * std::pow(1 - t, 4) + .5 * std::cos(6 * (a.theta_i.radians() + a.theta_o.radians()));
  };
  std::vector<GonioAngles> angles;
  for (const GonioAngles& a : polar_grid({10.3, 25.1, 40.4, 55.2}, 3, 6)) angles.push_back(a);
  const Check check = run(check_reciprocity, sweep(angles, percent, 2, truth));
  INFO(check.detail);
  CHECK(check.verdict != Verdict::fail);
}

TEST_CASE("A goniometer's grid, fine in wo and coarse in theta_i, has its partners interpolated between incidences") {
  std::vector<GonioAngles> angles;
  for (double theta = 7.3; theta < 80; theta += 9)
    for (const GonioAngles& a : polar_grid({theta}, 4, 10)) angles.push_back(a);
  for (const double s : {10., 100.}) {
    const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, s);
    const auto data = readings(truth, angles, percent, 3);
    const Check fair = run(check_reciprocity, data);
    for (std::size_t k = 0; k < angles.size(); ++k) data->f[0][k] *= 1 + .05 * (angles[k].theta_i.cos() - angles[k].theta_o.cos());
    const Check skewed = run(check_reciprocity, data);
    INFO(s << ": " << fair.detail << " / " << skewed.detail);
    CHECK(fair.n > 1000);
    CHECK(fair.verdict == Verdict::pass);
    CHECK(*fair.statistic / static_cast<double>(fair.n) > .9);
    CHECK(*fair.statistic / static_cast<double>(fair.n) < 1.1);
    CHECK(skewed.verdict == Verdict::fail);
  }
}
