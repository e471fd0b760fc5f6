// SPDX-License-Identifier: BSD-3-Clause
// Round trips, limits, stay-out, shadow and spot of the spherical gantry.
#include "acquisition/kinematics.hpp"

#include <cmath>
#include <random>

#include "brdf/error.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;

namespace {

constexpr unsigned seed = 20260702;

Bench gantry() {
  Bench bench;
  bench.kinematics = "spherical-gantry";
  for (const char* name : {"platform", "light", "detector_azimuth", "detector_zenith"}) {
    Axis axis;
    axis.name = name;
    bench.axes.push_back(axis);
  }
  bench.axes[1].lower_deg = bench.axes[3].lower_deg = -175;
  bench.axes[1].upper_deg = bench.axes[3].upper_deg = 175;
  bench.apertures = {0.0, 0.0, 0.004, 0.02};
  return bench;
}

Pose pose_deg(double theta_i, double phi_i, double theta_o, double phi_o) {
  return {degrees(theta_i), degrees(phi_i), degrees(theta_o), degrees(phi_o)};
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

}  // namespace

TEST_CASE("every solution of a random pose gives the pose back to a few roundings") {
  const Bench bench = gantry();
  const auto kinematics = make_kinematics(bench);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> theta(-170, 170), phi(-400, 400);
  std::size_t solutions = 0;
  for (int n = 0; n < 5000; ++n) {
    const Pose pose = pose_deg(theta(random), phi(random), theta(random), phi(random));
    INFO("seed " << seed << ", draw " << n);
    for (const AxisAngles& axes : kinematics->solutions(pose)) {
      ++solutions;
      const Pose back = kinematics->pose(axes);
      // A chord below 1e-13 is an angle below 1e-13 rad; the azimuths are a sum of three numbers of up to 720.
      CHECK(angle_between(back.wi(), pose.wi()).radians() < 1e-13);
      CHECK(angle_between(back.wo(), pose.wo()).radians() < 1e-13);
      CHECK(back.theta_i.degrees() == std::abs(pose.theta_i.degrees()));
      CHECK(back.theta_o.degrees() == std::abs(pose.theta_o.degrees()));
      const bool turned_i = pose.theta_i.degrees() < 0, turned_o = pose.theta_o.degrees() < 0;
      CHECK(apart(back.phi_i.degrees(), pose.phi_i.degrees() + (turned_i ? 180 : 0)) < 1e-12);
      CHECK(apart(back.phi_o.degrees(), pose.phi_o.degrees() + (turned_o ? 180 : 0)) < 1e-12);
      for (std::size_t k = 0; k < axes.size(); ++k) {
        CHECK(axes[k] >= bench.axes[k].lower_deg);
        CHECK(axes[k] <= bench.axes[k].upper_deg);
      }
      CHECK(std::abs(axes[1]) <= 170);
      CHECK(std::abs(axes[3]) <= 170);
    }
  }
  CHECK(solutions >= 4 * 5000);
}

TEST_CASE("a pose on the grid of counts comes back bit for bit") {
  const auto kinematics = make_kinematics(gantry());
  const Pose pose = pose_deg(35, 120, 50.5, -61.25);
  for (const AxisAngles& axes : kinematics->solutions(pose)) {
    const Pose back = kinematics->pose(axes);
    CHECK(back.theta_i.degrees() == 35);
    CHECK(back.phi_i.degrees() == 120);
    CHECK(back.theta_o.degrees() == 50.5);
    CHECK(back.phi_o.degrees() == -61.25);
  }
}

TEST_CASE("normal incidence and normal exit keep the azimuths they were given") {
  const auto kinematics = make_kinematics(gantry());
  const auto solutions = kinematics->solutions(pose_deg(0, 30, 0, 75));
  REQUIRE(solutions.size() == 1);
  const Pose back = kinematics->pose(solutions[0]);
  CHECK(back.theta_i.degrees() == 0);
  CHECK(back.phi_i.degrees() == 30);
  CHECK(back.theta_o.degrees() == 0);
  CHECK(back.phi_o.degrees() == 75);
  CHECK(kinematics->solutions(pose_deg(0, 0, 40, 10)).size() == 2);
}

TEST_CASE("a signed zenith angle is the direction on the other side") {
  const auto kinematics = make_kinematics(gantry());
  const Pose back = kinematics->pose({0, -30, 0, -60});
  CHECK(back.theta_i.degrees() == 30);
  CHECK(back.phi_i.degrees() == 180);
  CHECK(back.theta_o.degrees() == 60);
  CHECK(back.phi_o.degrees() == 180);
  // The platform turns the sample counter-clockwise, so azimuths in its frame fall.
  CHECK(kinematics->pose({20, 30, 0, 60}).phi_i.degrees() == -20);
  CHECK(kinematics->pose({20, 30, 90, 60}).phi_o.degrees() == 70);
}

TEST_CASE("full turns are solutions where the limits allow them, the nearest first") {
  Bench bench = gantry();
  bench.axes[0].lower_deg = -400;
  bench.axes[0].upper_deg = 400;
  const auto kinematics = make_kinematics(bench);
  const Pose pose = pose_deg(30, 10, 40, 100);
  CHECK(kinematics->solutions(pose).size() ==
        3 * 2 + 2 * 2);  // platform at -370, -10, 350 (light upright) or 170, -190 (light signed); detector signs
  const AxisAngles near{340, 30, 90, 40};
  CHECK(kinematics->solutions(pose, &near).front() == AxisAngles{350, 30, 90, 40});
  CHECK(kinematics->solutions(pose).front()[0] == -10);
}

TEST_CASE("what cannot be reached names axis, angle and limit") {
  Bench bench = gantry();
  bench.axes[3].lower_deg = -80;
  bench.axes[3].upper_deg = 80;
  const auto kinematics = make_kinematics(bench);
  const Pose grazing = pose_deg(30, 0, 85, 180);
  CHECK(kinematics->solutions(grazing).empty());
  CHECK(kinematics->unreachable_reason(grazing) == "axis detector_zenith: 85° is above its limit of 80°");
  const Pose bottom = pose_deg(172, 0, 40, 180);
  CHECK(kinematics->solutions(bottom).empty());
  CHECK(kinematics->unreachable_reason(bottom) == "axis light: 172° is above its stay-out at the bottom of 170°");
  CHECK_FALSE(kinematics->solutions(pose_deg(170, 0, 80, 180)).empty());
}

TEST_CASE("an axis that cannot turn far enough is named too") {
  Bench bench = gantry();
  bench.axes[0].lower_deg = -20;
  bench.axes[0].upper_deg = 20;
  bench.axes[1].lower_deg = 0;
  const auto kinematics = make_kinematics(bench);
  const Pose pose = pose_deg(30, 90, 40, 0);
  CHECK(kinematics->solutions(pose).empty());
  CHECK(kinematics->unreachable_reason(pose) == "axis platform: -90° is below its limit of -20°");
}

TEST_CASE("the head's shadow is a cone about the retro direction, the same with light and detector exchanged") {
  Bench bench = gantry();
  bench.detector_distance_m = 0.7;
  bench.head_radius_m = 0.03;
  bench.beam_radius_m = 0.005;
  bench.shadow_margin_deg = 0.5;
  bench.apertures.spot_diameter_m = bench.apertures.field_diameter_m = 0.0;
  const auto kinematics = make_kinematics(bench);
  const double cone = 2.8659839825988622 + 0.5;  // asin(0.05) + margin
  CHECK(kinematics->masked(pose_deg(30, 0, 30 + cone - 0.01, 0)).has_value());
  CHECK_FALSE(kinematics->masked(pose_deg(30, 0, 30 + cone + 0.01, 0)).has_value());
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> theta(0, 60), phi(-8, 8);
  std::size_t masked = 0;
  for (int n = 0; n < 2000; ++n) {
    const Pose pose = pose_deg(theta(random), 0, theta(random), phi(random));
    const Pose exchanged{pose.theta_o, pose.phi_o, pose.theta_i, pose.phi_i};
    CHECK(kinematics->masked(pose).has_value() == kinematics->masked(exchanged).has_value());
    if (kinematics->masked(pose)) ++masked;
  }
  CHECK(masked > 50);
}

TEST_CASE("a spot that leaves the field is masked with the reason") {
  const auto kinematics = make_kinematics(gantry());  // spot 4 mm, field 20 mm: the spot fits up to cos theta_i = 0.2 seen from above
  CHECK_FALSE(kinematics->masked(pose_deg(78.4, 0, 0, 0)).has_value());
  const auto reason = kinematics->masked(pose_deg(78.6, 0, 0, 0));
  REQUIRE(reason.has_value());
  CHECK(reason->find("the spot exceeds the field") == 0);
  // In the plane of incidence the field grows too; across it it does not.
  CHECK_FALSE(kinematics->masked(pose_deg(82, 0, 60, 180)).has_value());
  CHECK(kinematics->masked(pose_deg(82, 0, 60, 90)).has_value());
}

TEST_CASE("poses at and below the horizon are masked") {
  const auto kinematics = make_kinematics(gantry());
  CHECK(kinematics->masked(pose_deg(90, 0, 30, 180)).has_value());
  CHECK(kinematics->masked(pose_deg(30, 0, 90, 180)).has_value());
  CHECK(kinematics->masked(pose_deg(30, 0, 100, 180)).has_value());
  CHECK_FALSE(kinematics->masked(pose_deg(30, 0, 89.9, 180)).has_value());
}

TEST_CASE("wrong kinematics and wrong axes are refused") {
  Bench bench = gantry();
  bench.kinematics = "robot-arm";
  CHECK_THROWS_AS(make_kinematics(bench), Error);
  bench = gantry();
  std::swap(bench.axes[0], bench.axes[1]);
  CHECK_THROWS_AS(make_kinematics(bench), Error);
  bench = gantry();
  bench.axes.pop_back();
  CHECK_THROWS_AS(make_kinematics(bench), Error);
}
