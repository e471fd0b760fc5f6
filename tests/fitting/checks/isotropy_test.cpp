// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fitting/checks/tilt.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("isotropy: isotropic data pass and are seldom refused") {
  const Check check = run(check_isotropy, sweep(turned_poses(), percent, 5));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::pass);
  CHECK(check.n == 24);
  CHECK(refused(check_isotropy, turned_poses(), percent) <= most_refused);
}
TEST_CASE("isotropy: an anisotropic sample fails and a tilt is told from it") {
  const auto brushed = [](const GonioAngles& a) { return 1 + .06 * std::cos(2 * a.phi_i.radians()); };
  const Check check = run(check_isotropy, sweep(turned_poses(), percent, 5, brushed));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(.06 / std::numbers::sqrt2).epsilon(0.15));
  CHECK(check.detail.find("twice per turn") != std::string::npos);
  const Check tilt = run(check_isotropy, sweep(turned_poses(), percent, 5, [](const GonioAngles& a) { return 1 + .06 * a.phi_i.sin(); }));
  CHECK(tilt.detail.find("once per turn") != std::string::npos);
}
TEST_CASE("isotropy: data sets of the rotated sample are compared pose by pose") {
  CheckSubject same, turned;
  CheckOptions options;
  for (unsigned k = 0; k < 4; ++k) {
    const double rotation = 30.0 * k;
    options.rotation_deg.push_back(rotation);
    same.datasets.push_back(sweep(polar_grid({20, 50}, 20, 45), percent, 10 + k));
    turned.datasets.push_back(sweep(polar_grid({20, 50}, 20, 45), percent, 10 + k,
                                    [&](const GonioAngles&) { return 1 + .1 * std::cos(2 * rotation * std::numbers::pi / 180); }));
  }
  CHECK(check_isotropy(same, options).verdict == Verdict::pass);
  CHECK(check_isotropy(turned, options).verdict == Verdict::fail);
}
TEST_CASE("isotropy is vacuous at one azimuth of the sample, by construction and without u; mirror pairs do not count") {
  const Check one = run(check_isotropy, sweep(polar_grid({20, 50}, 20, 45), percent, 1));
  CHECK(one.verdict == Verdict::vacuous);
  CHECK(one.n == 0);
  auto flagged = sweep(turned_poses(), percent, 1);
  flagged->symmetry.isotropic = true;
  CHECK(run(check_isotropy, flagged).verdict == Verdict::vacuous);
  auto bare = sweep(turned_poses(), percent, 1);
  bare->u.clear();
  CHECK(run(check_isotropy, bare).verdict == Verdict::vacuous);
}

TEST_CASE("isotropy: a tilted normal is told from an anisotropic sample, by its harmonic and by the slope of the lobe") {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, 1000);
  std::vector<GonioAngles> angles;
  for (double turn = 0; turn < 360; turn += 30)
    for (const double theta : {20., 40., 60.})
      for (const double off : {-6., -3., 0., 3., 6.})
        for (const double side : {177., 180., 183.})
          angles.push_back({degrees(theta), degrees(turn), degrees(theta + off), degrees(turn + side)});
  auto tilted = readings(truth, angles, percent, 4);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double ratio =
        truth.eval(seen_by_tilted(angles[k], TiltFrame::sample, .1 * std::numbers::pi / 180, 0))[0] / truth.eval(angles[k])[0];
    tilted->f[0][k] *= ratio, tilted->u[0][k] *= ratio;
  }
  const Check tilt = run(check_isotropy, tilted);
  INFO(tilt.detail);
  CHECK(tilt.verdict == Verdict::warn);
  CHECK(tilt.detail.find("a tilt of the normal by 0.1") != std::string::npos);
  CHECK(tilt.detail.find("not a violation of isotropy") != std::string::npos);
  auto brushed = readings(truth, angles, percent, 4);
  for (std::size_t k = 0; k < angles.size(); ++k) brushed->f[0][k] *= 1 + .06 * std::cos(2 * angles[k].phi_i.radians());
  const Check anisotropic = run(check_isotropy, brushed);
  INFO(anisotropic.detail);
  CHECK(anisotropic.verdict == Verdict::fail);
  CHECK(anisotropic.detail.find("twice per turn") != std::string::npos);
}
