// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/distorted_angles.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::tabulated {
namespace {

constexpr double horizon_deg = 90;

struct DiskPoint {
  double x, y;
};

/// Radius in parts of the way from the normal to the horizon.
DiskPoint disk(const Direction& w) {
  const double sine = std::hypot(w.x(), w.y());
  if (!(sine > 0)) return {0, 0};
  const double radius = w.theta().degrees() / horizon_deg;
  return {radius * w.x() / sine, radius * w.y() / sine};
}

}  // namespace

Direction from_distorted(const Direction& pole, const DistortedAngles& node) {
  const DiskPoint centre = disk(pole);
  const double r = node.polar_deg / horizon_deg;
  const Angle azimuth = degrees(node.azimuth_deg);
  const double x = r * azimuth.cos() + (1 - r) * centre.x, y = r * azimuth.sin() + (1 - r) * centre.y;
  return Direction::spherical(degrees(horizon_deg * std::hypot(x, y)), angle_of(y, x));
}

DistortedAngles to_distorted(const Direction& pole, const Direction& wo) {
  const DiskPoint centre = disk(pole), at = disk(wo);
  const double dx = at.x - centre.x, dy = at.y - centre.y;
  // |d + r centre| = r:  a r² + 2 b r - |d|² = 0 with one root that is not negative.
  const double a = std::max(0.0, 1 - centre.x * centre.x - centre.y * centre.y);
  const double b = -(dx * centre.x + dy * centre.y), square = dx * dx + dy * dy;
  const double root = std::sqrt(b * b + a * square);
  // Of two forms the one that subtracts nothing; a vanishes for a pole on the horizon, where b does not become negative.
  const double denominator = b + root;
  const double r = b >= 0 ? (denominator > 0 ? square / denominator : 0) : (root - b) / a;
  const double azimuth = angle_of(dy + r * centre.y, dx + r * centre.x).degrees();
  return {horizon_deg * std::clamp(r, 0.0, 1.0), azimuth < 0 ? azimuth + 360 : azimuth};
}

}  // namespace gonio::tabulated
