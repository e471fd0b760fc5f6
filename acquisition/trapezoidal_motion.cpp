// SPDX-License-Identifier: BSD-3-Clause
// Duration, distance and speed of a trapezoidal (or, for short moves, triangular) speed profile.
#include "acquisition/trapezoidal_motion.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::acquisition {
namespace {

double peak_speed(double distance, double speed, double acceleration) noexcept {
  return std::min(speed, std::sqrt(std::abs(distance) * acceleration));
}

}  // namespace

double move_duration_s(double distance, double speed, double acceleration) noexcept {
  if (distance == 0) return 0;
  const double peak = peak_speed(distance, speed, acceleration);
  return std::abs(distance) / peak + peak / acceleration;
}

double moved_distance(double distance, double speed, double acceleration, double t) noexcept {
  const double duration = move_duration_s(distance, speed, acceleration);
  if (t <= 0) return 0;
  if (t >= duration) return distance;
  const double peak = peak_speed(distance, speed, acceleration), ramp = peak / acceleration, length = std::abs(distance);
  const double left = duration - t;
  double gone;
  if (t < ramp) {
    gone = acceleration * t * t / 2;
  } else if (left < ramp) {
    gone = length - acceleration * left * left / 2;
  } else {
    gone = peak * (t - ramp / 2);
  }
  return std::copysign(gone, distance);
}

double speed_at(double distance, double speed, double acceleration, double t) noexcept {
  const double left = move_duration_s(distance, speed, acceleration) - t;
  if (t <= 0 || left <= 0) return 0;
  return std::min({peak_speed(distance, speed, acceleration), acceleration * t, acceleration * left});
}

}  // namespace gonio::acquisition
