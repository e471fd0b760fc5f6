// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>
#include <memory>
#include <string>

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("energy: the customary Blinn-Phong normalisation reflects more than it receives") {
  const CheckSubject subject{{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .05, .93, 8.764))};
  const Check check = check_energy(subject, {});
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(1.0499).margin(5e-5));
  CHECK(check.detail.find("1.0499") != std::string::npos);
  const CheckSubject exact{{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong-exact", .05, .93, 8.764))};
  CHECK(check_energy(exact, {}).verdict == Verdict::pass);
}
TEST_CASE("energy: scattered samples of a bright surface fail, of a modest one pass, seldom refused at exactly one") {
  const auto albedo_of = [](double rho_d, unsigned seed) {
    return run(check_energy,
               readings(AnalyticBrdf("lambert", single_channel("Y"), {{rho_d}}), polar_grid({20, 60}, 10, 15), percent, seed));
  };
  const Check bright = albedo_of(1.05, 1), modest = albedo_of(.6, 2);
  INFO(bright.detail << " / " << modest.detail);
  CHECK(bright.verdict == Verdict::fail);
  CHECK(*bright.effect == Approx(1.05).epsilon(0.01));
  CHECK(modest.verdict == Verdict::pass);
  CHECK(*modest.effect == Approx(.6).epsilon(0.01));
  int refused_at_one = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) refused_at_one += *albedo_of(1, seed).p_value < 0.01;
  CHECK(refused_at_one <= 3);
}
TEST_CASE("energy: a node on an unresolved peak is no proof, and one plane of samples is vacuous") {
  // s = 1e5 on a 10° grid: the nearest-sample rule would put the albedo far above one.
  const Check sharp = run(check_energy, readings(lobe("blinn-phong", .1, .5, 1e5), polar_grid({20}, 10, 15), percent, 1));
  INFO(sharp.detail);
  CHECK(sharp.verdict == Verdict::vacuous);
  std::vector<GonioAngles> plane;
  for (double theta = 0; theta <= 80; theta += 5)
    for (const double phi : {0., 180.}) plane.push_back({degrees(30), degrees(0), degrees(theta), degrees(phi)});
  const Check line = run(check_energy, readings(lobe("blinn-phong", .1, .5, 10), plane, percent, 1));
  INFO(line.detail);
  CHECK(line.verdict == Verdict::vacuous);
  CHECK(run(check_energy, readings(lobe("blinn-phong", .1, .5, 10), polar_grid({20}, 40, 90), percent, 1)).verdict == Verdict::vacuous);
}
TEST_CASE("energy: a function without a closed form is integrated") {
  struct Wrapped final : Brdf {
    AnalyticBrdf inner = lobe("blinn-phong", .05, .93, 8.764);
    const Channels& channels() const override { return inner.channels(); }
    Symmetry symmetry() const override { return inner.symmetry(); }
    void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override { inner.eval(wi, wo, f); }
  };
  const Check check = check_energy({{}, nullptr, std::make_shared<Wrapped>()}, {});
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(1.0499).margin(5e-4));
}

TEST_CASE("energy: every incidence is listed with its uncertainties, and the ones above one are counted") {
  const Check check = run(check_energy, readings(lobe("blinn-phong", .5, .6, 50), polar_grid({10, 30, 60}, 10, 15), percent, 3));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  REQUIRE(check.incidences.size() == 3);
  CHECK(check.incidences[1].theta_i_deg == Approx(30));
  CHECK(check.incidences[0].albedo == Approx(lobe("blinn-phong", .5, .6, 50).directional_albedo(degrees(10))[0]).epsilon(.02));
  CHECK(check.incidences[0].u_noise > 0);
  CHECK(check.incidences[0].u_quadrature < .02);
  CHECK(check.detail.find("of 3 incidences") != std::string::npos);
}
