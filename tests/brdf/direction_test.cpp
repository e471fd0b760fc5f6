// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/direction.hpp"

#include <limits>
#include <type_traits>

#include "brdf/error.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

// Directions of different frames do not mix.
template <class A, class B>
concept dottable = requires(A a, B b) {
  dot(a, b);
};
static_assert(dottable<Direction, Direction>);
static_assert(!dottable<Direction, UnitVector<BenchFrame>>);
static_assert(!std::is_convertible_v<UnitVector<BenchFrame>, Direction>);

TEST_CASE("a direction of zero, infinite or unknown length is refused") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(Direction::normalized(0, 0, 0), Error);
  CHECK_THROWS_AS(Direction::normalized(nan, 0, 1), Error);
  CHECK_THROWS_AS(Direction::normalized(0, inf, 1), Error);
}

TEST_CASE("a direction is normalised without over- or underflow") {
  const Direction tiny = Direction::normalized(3e-300, 0, 4e-300), huge = Direction::normalized(3e300, 0, 4e300);
  constexpr double rounding_only = 1e-15;
  CHECK(tiny.x() == Approx(0.6).margin(rounding_only));
  CHECK(huge.z() == Approx(0.8).margin(rounding_only));
}

TEST_CASE("a negative zenith angle means the opposite azimuth") {
  const Direction negative = Direction::spherical(-30_deg, 20_deg), positive = Direction::spherical(30_deg, 200_deg);
  constexpr double rounding_only = 1e-15;
  CHECK(std::fabs(negative.x() - positive.x()) < rounding_only);
  CHECK(std::fabs(negative.y() - positive.y()) < rounding_only);
  CHECK(negative.z() == positive.z());
}

TEST_CASE("the angle between directions is exact where acos is blind") {
  const Direction a = Direction::spherical(0_deg, 0_deg), b = Direction::spherical(radians(1e-9), 0_deg);
  CHECK(angle_between(a, b).radians() == Approx(1e-9).epsilon(1e-12));
  CHECK(std::acos(dot(a, b)) == 0.0);  // what the naive form says
  CHECK(angle_between(a, Direction::spherical(180_deg, 0_deg)).degrees() == Approx(180));
}

TEST_CASE("spherical angles come back from a direction") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  constexpr double rounding_only = 1e-12;  // degrees
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const double theta = test::uniform(random, 0.01, 179.9), phi = test::uniform(random, -179.9, 179.9);
    const Direction d = Direction::spherical(degrees(theta), degrees(phi));
    worst = std::fmax(worst, std::fabs(d.theta().degrees() - theta));
    worst = std::fmax(worst, std::sin(theta * std::numbers::pi / 180) * std::fabs(d.phi().degrees() - phi));
  }
  CHECK(worst < rounding_only);
}
