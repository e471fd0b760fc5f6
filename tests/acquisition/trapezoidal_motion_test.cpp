// SPDX-License-Identifier: BSD-3-Clause
// Trapezoidal and triangular speed profiles.
#include "acquisition/trapezoidal_motion.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio::acquisition;

TEST_CASE("A move lasts d/v + v/a, a short one 2 sqrt(d/a)") {
  CHECK(move_duration_s(90, 30, 60) == Approx(90.0 / 30 + 30.0 / 60));
  CHECK(move_duration_s(-90, 30, 60) == Approx(3.5));
  CHECK(move_duration_s(1, 30, 60) == Approx(2 * std::sqrt(1.0 / 60)));
  CHECK(move_duration_s(0, 30, 60) == 0);
}

TEST_CASE("A move starts and ends at rest, stays within its speed, and its speed is the slope of its distance") {
  for (const double distance : {-90.0, -0.3, 1e-6, 2.0, 15.0, 15.1, 180.0}) {
    const double speed = 30, acceleration = 60, duration = move_duration_s(distance, speed, acceleration);
    CHECK(moved_distance(distance, speed, acceleration, 0) == 0);
    CHECK(moved_distance(distance, speed, acceleration, -1) == 0);
    CHECK(moved_distance(distance, speed, acceleration, duration) == distance);
    constexpr int steps = 1000;
    constexpr double second_order = 1e-4;  // of the midpoint rule over a thousandth of the move, and of its two corners
    double gone = 0;
    for (int k = 0; k < steps; ++k) {
      const double t = duration * (k + 0.5) / steps;
      const double v = speed_at(distance, speed, acceleration, t);
      CHECK((v >= 0 && v <= speed));
      gone += v * duration / steps;
      const double next = std::abs(moved_distance(distance, speed, acceleration, duration * (k + 1) / steps));
      CHECK(std::abs(next - gone) <= second_order * std::abs(distance));
    }
  }
}
