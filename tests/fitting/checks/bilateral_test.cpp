// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("bilateral: a symmetric sample passes and is seldom refused") {
  const Check check = run(check_bilateral, sweep(polar_grid({20, 50}, 10, 15), percent, 5));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::pass);
  CHECK(check.n == 2 * 8 * 11);
  CHECK(refused(check_bilateral, polar_grid({20, 50}, 10, 15), percent) <= most_refused);
}

TEST_CASE("bilateral: a difference between the sides warns with its size, and never fails, because an instrument can do it") {
  const Check check = run(check_bilateral, sweep(polar_grid({20, 50}, 10, 15), percent, 5, [](const GonioAngles& a) {
                            return 1 + .05 * a.theta_o.sin() * (a.phi_o - a.phi_i).sin();
                          }));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::warn);
  CHECK(*check.effect > .02);
  CHECK(check.detail.find("the side of the plane of incidence") != std::string::npos);
  CHECK(check.detail.find("turn the sample to tell") != std::string::npos);
}

TEST_CASE("bilateral is vacuous by construction and where one side only was measured") {
  auto flagged = sweep(polar_grid({20}, 10, 15), percent, 1);
  flagged->symmetry.bilateral = true;
  CHECK(run(check_bilateral, flagged).verdict == Verdict::vacuous);
  std::vector<GonioAngles> half;
  for (const GonioAngles& a : polar_grid({20}, 10, 15))
    if (a.phi_o.degrees() > 10 && a.phi_o.degrees() < 170) half.push_back(a);
  CHECK(run(check_bilateral, sweep(half, percent, 1)).verdict == Verdict::vacuous);
}
