// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/beta_offset.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Length 0 is the specular direction, azimuth 0 leads forward, 180 back to the light") {
  const Direction wi = Direction::spherical(30_deg, 20_deg);
  CHECK(to_beta_offset(wi, Direction::spherical(30_deg, 200_deg)).length < 1e-15);
  const BetaOffset forward = to_beta_offset(wi, Direction::spherical(50_deg, 200_deg));
  CHECK(forward.length == Approx(std::sin(50 * std::numbers::pi / 180) - 0.5).epsilon(1e-12));
  CHECK(std::fabs(std::remainder(forward.azimuth_deg, 360)) < 1e-10);
  CHECK(to_beta_offset(wi, wi).azimuth_deg == Approx(180).epsilon(1e-12));
  CHECK(to_beta_offset(wi, wi).length == Approx(1).epsilon(1e-12));
  CHECK_FALSE(from_beta_offset(30_deg, 0_deg, 0.5, 180_deg, Side::reflection));  // sin theta_o = 1
  CHECK(from_beta_offset(30_deg, 0_deg, 0, 0_deg, Side::transmission)->theta_o.degrees() == Approx(150).epsilon(1e-12));
}

TEST_CASE("Offsets and directions lead back to each other on both sides") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Side side = k % 2 == 0 ? Side::reflection : Side::transmission;
    const Direction wi = test::upper_direction(random), up = test::upper_direction(random);
    if (up.z() < 0.01) continue;  // the sine loses the digits of a grazing direction
    const Direction wo = side == Side::reflection ? up : Direction::trusted(up.x(), up.y(), -up.z());
    const BetaOffset offset = to_beta_offset(wi, wo);
    const Angle azimuth = wi.phi() + degrees(180 + offset.azimuth_deg);
    const auto pose = from_beta_offset(wi.theta(), wi.phi(), offset.length, azimuth, side);
    REQUIRE(pose);
    worst = std::max(worst, angle_between(pose->wo(), wo).degrees());
  }
  CHECK(worst < 1e-10);
}
