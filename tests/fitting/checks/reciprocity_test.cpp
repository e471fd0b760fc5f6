// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fitting/checks/tilt.hpp"
#include "tests/fitting/checks/refusals.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("reciprocity: reciprocal data pass and are seldom refused") {
  const Check check = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::pass);
  CHECK(check.n == 435);
  CHECK(refused(check_reciprocity, pairs_of_directions(), percent) <= most_refused);
}
TEST_CASE("reciprocity: an asymmetry of 5 % fails, one of 1 % warns, and the effect is its size") {
  const auto skew = [](double size) { return [size](const GonioAngles& a) { return 1 + size * (a.theta_i.cos() - a.theta_o.cos()); }; };
  const Check large = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5, skew(.2)));
  INFO(large.detail);
  CHECK(large.verdict == Verdict::fail);
  CHECK(large.detail.find("cosines") != std::string::npos);
  // f differs by 2 · 0.2 · (cos i - cos o); rms over the pairs.
  double square = 0, count = 0;
  for (const GonioAngles& a : pairs_of_directions()) square += std::pow(.4 * (a.theta_i.cos() - a.theta_o.cos()), 2), count += 1;
  CHECK(*large.effect == Approx(std::sqrt(square / count)).epsilon(0.15));
  const Check small = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5, skew(.015)));
  INFO(small.detail);
  CHECK(small.verdict == Verdict::warn);
}
TEST_CASE("reciprocity: a common scale is no asymmetry") {
  auto data = sweep(pairs_of_directions(), percent, 6);
  for (double& f : data->f[0]) f *= 1.3;
  data->correlated.push_back({"scale", 0.05, {}});
  CHECK(run(check_reciprocity, data).verdict == Verdict::pass);
}
TEST_CASE("reciprocity: a known tilt is no asymmetry, an unknown one is") {
  std::vector<double> sensitivity;
  const auto angles = pairs_of_directions();
  for (const GonioAngles& a : angles) sensitivity.push_back(a.wi().x() - a.wo().x());
  auto data = sweep(angles, percent, 6, [](const GonioAngles& a) { return 1 + .04 * (a.wi().x() - a.wo().x()); });
  CHECK(run(check_reciprocity, data).verdict == Verdict::fail);
  data->correlated.push_back({"tilt", 0.04, sensitivity});
  CHECK(run(check_reciprocity, data).verdict == Verdict::pass);
}
TEST_CASE("reciprocity is vacuous by construction, without partners, without u and with too much noise") {
  auto flagged = sweep(pairs_of_directions(), percent, 1);
  flagged->symmetry.reciprocal = true;
  CHECK(run(check_reciprocity, flagged).verdict == Verdict::vacuous);
  const Check alone = run(check_reciprocity, sweep(polar_grid({33}, 10, 45), percent, 1));
  CHECK(alone.verdict == Verdict::vacuous);
  CHECK(alone.detail.find("partner") != std::string::npos);
  auto bare = sweep(pairs_of_directions(), {0, 0, 0.3}, 1);
  bare->u.clear();
  const Check unknown = run(check_reciprocity, bare);
  INFO(unknown.detail);
  CHECK(unknown.verdict == Verdict::vacuous);
  CHECK(unknown.effect.value_or(0) > 0.05);
  CHECK(!unknown.p_value);
  const Check blurred = run(check_reciprocity, sweep(pairs_of_directions(), {0, 0, 0.5}, 1));
  INFO(blurred.detail);
  CHECK(blurred.verdict == Verdict::vacuous);
}

namespace {

/// In-plane partners at phi_i = 0 only: the sample stage does not turn.
std::vector<GonioAngles> in_one_azimuth() {
  std::vector<GonioAngles> out;
  for (double a = 5; a <= 65; a += 5)
    for (double b = 5; b <= 65; b += 5)
      for (const double phi : {0., 150., 175., 180., 185., 210.})
        if (a != b) out.push_back({degrees(a), degrees(0), degrees(b), degrees(a < b ? phi : 360 - phi)});
  return out;
}

}  // namespace

TEST_CASE("reciprocity without u: noise within the margin passes, asymmetry beyond what mirror pairs show fails") {
  const auto bare = [](double asymmetry) {
    auto data = sweep(pairs_of_directions(), {0, 0, 0.005}, 1,
                      [&](const GonioAngles& a) { return 1 + asymmetry * (a.theta_i.cos() - a.theta_o.cos()); });
    data->u.clear();
    return run(check_reciprocity, data);
  };
  const Check fair = bare(0), skewed = bare(.2);
  INFO(fair.detail << " / " << skewed.detail);
  CHECK(fair.verdict == Verdict::pass);
  CHECK(skewed.verdict == Verdict::fail);
  CHECK(skewed.detail.find("mirror pairs differ") != std::string::npos);
  CHECK(skewed.where.size() == CheckOptions{}.where);
  CHECK(!skewed.where[0].p_holm);
}

TEST_CASE("reciprocity: a normal tilted by 0.05° before a lobe of s = 5000 is called a tilt and warns; real asymmetry beside it fails") {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, 5000);
  const auto tilted = [&](double asymmetry) {
    auto data = readings(truth, in_one_azimuth(), percent, 11);
    for (std::size_t k = 0; k < data->size(); ++k) {
      const GonioAngles& a = data->angles[k];
      const double ratio = truth.eval(seen_by_tilted(a, TiltFrame::sample, .05 * std::numbers::pi / 180, 0))[0] / truth.eval(a)[0] *
                           (1 + asymmetry * (a.theta_i.cos() - a.theta_o.cos()));
      data->f[0][k] *= ratio, data->u[0][k] *= ratio;
    }
    return data;
  };
  const Check check = run(check_reciprocity, tilted(0));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::warn);
  CHECK(*check.p_value < 1e-6);
  CHECK(check.detail.find("a tilt of the normal by 0.05") != std::string::npos);
  CHECK(check.detail.find("not a violation of reciprocity") != std::string::npos);
  const Check both = run(check_reciprocity, tilted(.1));
  INFO(both.detail);
  CHECK(both.verdict == Verdict::fail);
}

TEST_CASE("reciprocity: uncertainties stated at half their size are called understated, not asymmetry") {
  auto data = sweep(pairs_of_directions(), {0, 0, 0.02}, 21);
  for (double& u : data->u[0]) u /= 2;
  const Check check = run(check_reciprocity, data);
  INFO(check.detail);
  CHECK(check.verdict == Verdict::warn);
  CHECK(check.detail.find("understated by a factor 2") != std::string::npos);
}

TEST_CASE("reciprocity: one pair that is off is found, and told by its angles") {
  auto data = sweep(pairs_of_directions(), percent, 7);
  data->f[0][17] *= 1.2;
  const Check check = run(check_reciprocity, data);
  INFO(check.detail);
  REQUIRE(check.where.size() == 1);
  CHECK(*check.where[0].p_holm < 1e-6);
  CHECK(std::abs(*check.where[0].z) > 8);
  const GonioAngles& found = check.where[0].angles;
  const GonioAngles& wrong = data->angles[17];
  const bool first = found.theta_i.degrees() == wrong.theta_i.degrees() && found.phi_o.degrees() == wrong.phi_o.degrees();
  const bool second = found.theta_i.degrees() == wrong.theta_o.degrees() && found.phi_o.degrees() == wrong.phi_i.degrees();
  CHECK((first || second));
  CHECK(run(check_reciprocity, sweep(pairs_of_directions(), percent, 7)).where.empty());
}

TEST_CASE("reciprocity: the directed test keeps its size and sees an asymmetry of 0.1 %, short run") {
  constexpr unsigned draws = 60;
  // Three standard deviations of a proportion of 5 % in so many draws.
  const double allowed = 3 * std::sqrt(.05 * .95 / draws);
  const Refusals null = refusals(0, 1, draws), skewed = refusals(.001, 5001, draws);
  INFO("size " << null.combined << " combined, " << null.directed << " directed; power " << skewed.combined << ", " << skewed.directed);
  CHECK(std::abs(null.directed - .05) <= allowed);
  CHECK(null.combined <= .05 + allowed);
  CHECK(skewed.directed >= .8 - allowed);
  CHECK(skewed.combined >= .8 - allowed);
}

TEST_CASE("reciprocity: data of one side of the plane of incidence have partners by folding, and that is said") {
  std::vector<GonioAngles> half;
  for (const double a : {10., 25., 40., 55., 70.})
    for (const double b : {10., 25., 40., 55., 70.})
      for (double phi = 10; phi < 180; phi += 10) half.push_back({degrees(a), degrees(0), degrees(b), degrees(phi)});
  const Check fair = run(check_reciprocity, sweep(half, percent, 5));
  const Check skewed =
      run(check_reciprocity, sweep(half, percent, 5, [](const GonioAngles& a) { return 1 + .1 * (a.theta_i.cos() - a.theta_o.cos()); }));
  INFO(fair.detail << " / " << skewed.detail);
  CHECK(fair.n == 170);
  CHECK(fair.detail.find("mirror symmetric") != std::string::npos);
  CHECK(fair.verdict == Verdict::pass);
  CHECK(skewed.verdict == Verdict::fail);
}
