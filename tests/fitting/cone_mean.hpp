// SPDX-License-Identifier: BSD-3-Clause
// The mean of a BRDF over the cones of source and receiver by brute force: nothing shared with the rules the fits use.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/coordinates.hpp"

namespace gonio::test {

/// Directions evenly over a cone, with their part of its projected solid angle; the part below the horizon is left out.
struct Cone {
  std::vector<Direction> direction;
  std::vector<double> weight;

  /// Midpoints of `rings` equal steps of sin(α/2) and of three times as many of azimuth; half-angle 0 gives the axis alone.
  Cone(const Direction& axis, double half_angle_rad, int rings) {
    if (!(half_angle_rad > 0)) {
      direction = {axis}, weight = {1};
      return;
    }
    // Any two directions square to the axis, from the coordinate axis that is farthest from it.
    const double x = axis.x(), y = axis.y(), z = axis.z();
    const bool upright = std::abs(z) > .7;
    const double ex = upright ? 1 : 0, ez = upright ? 0 : 1, along = upright ? x : z;
    const double length = std::sqrt(1 - along * along);
    const double ax = (ex - along * x) / length, ay = -along * y / length, az = (ez - along * z) / length;
    const double bx = y * az - z * ay, by = z * ax - x * az, bz = x * ay - y * ax;
    const double cap = 2 * std::pow(std::sin(half_angle_rad / 2), 2);
    double sum = 0;
    for (int r = 0; r < rings; ++r)
      for (int k = 0; k < 3 * rings; ++k) {
        const double radius = (r + .5) / rings, drop = cap * radius * radius, sine = std::sqrt(drop * (2 - drop)),
                     turn = 2 * std::numbers::pi * (k + .5) / (3 * rings);
        const double u = sine * std::cos(turn), v = sine * std::sin(turn), w = 1 - drop;
        const double height = w * z + u * az + v * bz;
        if (!(height > 0)) continue;
        direction.push_back(Direction::trusted(w * x + u * ax + v * bx, w * y + u * ay + v * by, height));
        weight.push_back(radius * height);
        sum += weight.back();
      }
    for (double& part : weight) part /= sum;
  }
};

/// The mean of value(wi, wo) over both cones; half-angles in radians, 0 for a point.
template <class Value>
double cone_mean(const GonioAngles& angles, double source_rad, double receiver_rad, int rings, Value&& value) {
  const Cone source(angles.wi(), source_rad, rings), receiver(angles.wo(), receiver_rad, rings);
  double mean = 0;
  for (std::size_t i = 0; i < source.direction.size(); ++i)
    for (std::size_t o = 0; o < receiver.direction.size(); ++o)
      mean += source.weight[i] * receiver.weight[o] * value(source.direction[i], receiver.direction[o]);
  return mean;
}

}  // namespace gonio::test
