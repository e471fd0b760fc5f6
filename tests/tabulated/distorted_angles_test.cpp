// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/distorted_angles.hpp"

#include <algorithm>
#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE(
    "Polar angle 0 is the pole, 90 degrees the horizon at that azimuth, and what lies between is linear on the disk of zenith angles") {
  const Direction pole = Direction::spherical(40_deg, 180_deg);
  CHECK(angle_between(from_distorted(pole, {0, 77}), pole).degrees() < 1e-12);
  for (const double azimuth : {0.0, 100.0, 180.0, 300.0}) {
    const Direction horizon = from_distorted(pole, {90, azimuth});
    CHECK(std::fabs(horizon.z()) < 1e-15);
    CHECK(std::fabs(std::remainder(horizon.phi().degrees() - azimuth, 360)) < 1e-12);
  }
  // Half way from 40 degrees on one side to 90 on the other: 25 degrees on the other.
  const Direction half = from_distorted(pole, {45, 0});
  CHECK(half.theta().degrees() == Approx(25).epsilon(1e-12));
  CHECK(std::fabs(half.phi().degrees()) < 1e-12);
  // With the pole at the normal they are ordinary polar coordinates.
  const Direction ordinary = from_distorted(Direction(), {30, 50});
  CHECK(ordinary.theta().degrees() == Approx(30).epsilon(1e-12));
  CHECK(ordinary.phi().degrees() == Approx(50).epsilon(1e-12));
}

TEST_CASE("Distorted angles and directions lead back to each other, for poles up to the horizon") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    const double theta = k % 10 == 0 ? 89.999 : test::uniform(random, 0, 89.9);
    const Direction pole = Direction::spherical(degrees(theta), degrees(test::uniform(random, 0, 360)));
    const Direction wo = test::upper_direction(random);
    const DistortedAngles angles = to_distorted(pole, wo);
    REQUIRE(angles.polar_deg <= 90);
    worst = std::max(worst, angle_between(from_distorted(pole, angles), wo).degrees());
  }
  // Near a pole on the horizon whole fans of nodes lie close together.
  CHECK(worst < 1e-9);
  CHECK(to_distorted(Direction::spherical(90_deg, 0_deg), Direction::spherical(90_deg, 0_deg)).polar_deg == 0);
}
