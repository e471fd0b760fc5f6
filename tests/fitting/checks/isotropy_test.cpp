// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>
#include <numbers>
#include <string>

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
