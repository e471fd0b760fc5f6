// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/specular_angles.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("Radial 0 is the mirror direction, azimuth 0 leads to the normal, 180 to the horizon, 90 to the left of the specular ray") {
  const GonioAngles specular = from_specular(30_deg, 20_deg, {0, 0}, Side::reflection);
  CHECK(specular.theta_o.degrees() == 30);
  CHECK(specular.phi_o.degrees() == 200);
  CHECK(from_specular(30_deg, 20_deg, {30, 0}, Side::reflection).theta_o.degrees() == 0);
  const GonioAngles beyond_normal = from_specular(30_deg, 20_deg, {50, 0}, Side::reflection);
  CHECK(beyond_normal.theta_o.degrees() == 20);
  CHECK(beyond_normal.phi_o.degrees() == 20);
  CHECK(from_specular(30_deg, 20_deg, {60, 180}, Side::reflection).theta_o.degrees() == 90);
  CHECK(from_specular(30_deg, 20_deg, {61, 180}, Side::reflection).theta_o.degrees() == 91);
  // Light in the xz plane from +x: specular towards -x; counter-clockwise from the normal, seen against the specular ray, is +y.
  const Direction left = from_specular(30_deg, 0_deg, {10, 90}, Side::reflection).wo();
  CHECK(std::fabs(left.y() - std::sin(10 * std::numbers::pi / 180)) < rounding);
  CHECK(left.x() < 0);
}

TEST_CASE("In transmission everything is mirrored at the surface: radial 0 goes straight on") {
  const GonioAngles straight = from_specular(30_deg, 20_deg, {0, 0}, Side::transmission);
  CHECK(straight.theta_o.degrees() == 150);
  CHECK(straight.phi_o.degrees() == 200);
  CHECK(from_specular(30_deg, 20_deg, {30, 0}, Side::transmission).theta_o.degrees() == 180);
}

TEST_CASE("Angles about the specular direction and directions lead back to each other") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (int k = 0; k < 2000; ++k) {
    const Side side = k % 2 == 0 ? Side::reflection : Side::transmission;
    const GonioAngles pair = test::gonio_pair(random);
    const SpecularAngles node{test::uniform(random, 0.01, 179), k % 5 == 0 ? 180 : test::uniform(random, 0, 360)};
    const GonioAngles pose = from_specular(pair.theta_i, pair.phi_i, node, side);
    const SpecularAngles back = to_specular(pose.wi(), pose.wo(), side);
    REQUIRE(std::fabs(back.radial_deg - node.radial_deg) < 1e-9);
    REQUIRE(std::fabs(std::remainder(back.azimuth_deg - node.azimuth_deg, 360)) * std::sin(node.radial_deg * std::numbers::pi / 180) <
            1e-9);
    REQUIRE(std::fabs(angle_between(pose.wo(), from_specular(pair.theta_i, pair.phi_i, {0, 0}, side).wo()).degrees() - node.radial_deg) <
            1e-6);
  }
}

TEST_CASE("The horizon is where it is said to be") {
  for (const double azimuth : {0.0, 37.0, 90.0, 140.0, 180.0, 250.0})
    for (const double theta : {0.0, 10.0, 60.0, 89.0}) {
      const Angle radial = radial_of_horizon(degrees(theta), degrees(azimuth));
      const GonioAngles pose = from_specular(degrees(theta), 0_deg, {radial.degrees(), azimuth}, Side::reflection);
      CHECK(std::fabs(pose.theta_o.degrees() - 90) < 1e-9);
    }
}
