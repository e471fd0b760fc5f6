// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/angle.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("an angle made from degrees has exact cosines at the quadrants") {
  CHECK((90_deg).cos() == 0.0);
  CHECK_FALSE(std::signbit((90_deg).cos()));
  CHECK((180_deg).cos() == -1.0);
  CHECK((180_deg).sin() == 0.0);
  CHECK((270_deg).sin() == -1.0);
  CHECK((-90_deg).sin() == -1.0);
  CHECK((360_deg).cos() == 1.0);
  CHECK((0_deg).sin() == 0.0);
}

TEST_CASE("an angle near grazing loses no digit of its cosine") {
  // cos 89.99° = sin 0.01°, and 90 - 89.99 is exact in double; a conversion to radians first is wrong by 1e-13.
  const double elevation = (90 - 89.99) * std::numbers::pi / 180;
  const double stable = std::sin(elevation);
  constexpr double rounding_only = 4 * std::numeric_limits<double>::epsilon();
  CHECK(std::fabs((89.99_deg).cos() / stable - 1) < rounding_only);
  CHECK(std::fabs(std::cos(89.99 * std::numbers::pi / 180) / stable - 1) > 100 * rounding_only);  // the naive form fails this gate
}

TEST_CASE("an angle keeps the unit it was made from") {
  CHECK((30.1_deg).degrees() == 30.1);
  CHECK(radians(0.3).radians() == 0.3);
  CHECK((180.0001_deg - 180_deg).degrees() == 180.0001 - 180);
  CHECK((30_deg + radians(0)).made_from_degrees() == false);
  CHECK(half(45_deg).degrees() == 22.5);
  CHECK(angle_of(0, 0).radians() == 0);
}

TEST_CASE("an angle that is no number has no cosine") {
  const Angle nan = degrees(std::numeric_limits<double>::quiet_NaN()), infinite = degrees(std::numeric_limits<double>::infinity());
  CHECK(std::isnan(nan.cos()));
  CHECK(std::isnan(infinite.sin()));
}
