// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/convex_hull.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::tabulated {
namespace {

constexpr int most_steps = 60;

double dot(const PairPoint& a, const PairPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

PairPoint difference(const PairPoint& a, const PairPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}; }

}  // namespace

bool within_hull(const PairPoint& at, std::span<const PairPoint> points, double tolerance) noexcept {
  if (points.empty()) return false;
  PairPoint nearest = difference(points[0], at);  // of the part of the hull reached so far, seen from the place
  for (int step = 0; step < most_steps; ++step) {
    const double length = std::sqrt(dot(nearest, nearest));
    if (length <= tolerance) return true;
    PairPoint support = difference(points[0], at);
    for (const PairPoint& point : points)
      if (const PairPoint p = difference(point, at); dot(nearest, p) < dot(nearest, support)) support = p;
    if (dot(nearest, support) > tolerance * length) return false;  // a plane farther off than the tolerance separates them
    const PairPoint along = difference(support, nearest);
    const double squared = dot(along, along);
    if (!(squared > 0)) return true;
    const double part = std::clamp(-dot(nearest, along) / squared, 0.0, 1.0);
    for (std::size_t k = 0; k < nearest.size(); ++k) nearest[k] += part * along[k];
  }
  return true;
}

}  // namespace gonio::tabulated
