// SPDX-License-Identifier: BSD-3-Clause
// A move with a trapezoidal speed profile: the law that drives follow and that their arrival is predicted by.
#pragma once

namespace gonio::acquisition {

/// Seconds for `distance` (any sign) from rest to rest, accelerating and braking at `acceleration` and never faster than `speed`:
/// d/v + v/a if the speed is reached, 2 sqrt(d/a) otherwise. All in one unit of length, speed and acceleration positive.
double move_duration_s(double distance, double speed, double acceleration) noexcept;

/// Distance gone (in the sense of `distance`) at `t` seconds after the start; 0 before, all of it after the end.
double moved_distance(double distance, double speed, double acceleration, double t) noexcept;

/// Speed (positive) at `t` seconds after the start.
double speed_at(double distance, double speed, double acceleration, double t) noexcept;

}  // namespace gonio::acquisition
