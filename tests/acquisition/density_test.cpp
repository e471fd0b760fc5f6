// SPDX-License-Identifier: BSD-3-Clause
// Directions around the specular one.
#include "acquisition/density.hpp"

#include <algorithm>
#include <cmath>

#include "tests/check.hpp"

using namespace gonio;
using acquisition::specular_density;

namespace {

double apart(const acquisition::Pose& pose) { return angle_between(pose.wo(), Direction::spherical(pose.theta_i, degrees(180))).degrees(); }

}  // namespace

TEST_CASE("the first direction is the specular one, and half of them are within the width") {
  for (const double theta : {0.0, 10.0, 45.0, 70.0})
    for (const double width : {2.0, 12.0, 45.0}) {
      const auto poses = specular_density(theta, 200, width);
      REQUIRE(poses.size() == 200);
      CHECK(apart(poses[0]) < 1e-6);
      const auto within = std::count_if(poses.begin(), poses.end(), [&](const auto& pose) { return apart(pose) <= width + 0.001; });
      INFO("theta " << theta << ", width " << width << ", within " << within);
      CHECK(within >= 100);
      CHECK(within <= 140);  // directions folded back from the horizon add to it
    }
}

TEST_CASE("no direction is lower than 85 degrees or the light, and angles are thousandths of a degree") {
  for (const double theta : {-60.0, 0.0, 60.0, 84.0, 88.0})
    for (const auto& pose : specular_density(theta, 300, 20)) {
      CHECK(pose.theta_i.degrees() == std::abs(theta));
      CHECK(pose.theta_o.degrees() >= 0);
      CHECK(pose.theta_o.degrees() <= std::max(85.0, std::abs(theta)));
      CHECK(pose.theta_o.degrees() == std::round(pose.theta_o.degrees() * 1000) / 1000);
    }
}

TEST_CASE("no points are no directions") { CHECK(specular_density(30, 0, 15).empty()); }
