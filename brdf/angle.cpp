// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/angle.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace gonio {
namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

Angle Angle::from_radians(double value) noexcept {
  Angle angle;
  angle.radians_ = value;
  angle.degrees_ = value / degree;
  angle.cos_ = std::cos(value);
  angle.sin_ = std::sin(value);
  angle.from_degrees_ = false;
  return angle;
}

Angle Angle::from_degrees(double value) noexcept {
  Angle angle;
  angle.degrees_ = value;
  angle.radians_ = value * degree;
  if (!std::isfinite(value)) {
    angle.cos_ = angle.sin_ = angle.radians_ = std::numeric_limits<double>::quiet_NaN();
    return angle;
  }
  // remquo is exact: the remainder lies in [-45, 45] and the low bits of the quotient name the quadrant.
  int quadrant = 0;
  const double rest = std::remquo(value, 90.0, &quadrant);
  const double c = std::cos(rest * degree), s = std::sin(rest * degree);
  switch (quadrant & 3) {
    case 0: angle.cos_ = c, angle.sin_ = s; break;
    case 1: angle.cos_ = -s, angle.sin_ = c; break;
    case 2: angle.cos_ = -c, angle.sin_ = -s; break;
    default: angle.cos_ = s, angle.sin_ = -c; break;
  }
  angle.cos_ += 0.0;  // no negative zero: cos 90° is +0
  angle.sin_ += 0.0;
  return angle;
}

Angle operator+(Angle a, Angle b) noexcept {
  return a.made_from_degrees() && b.made_from_degrees() ? degrees(a.degrees() + b.degrees()) : radians(a.radians() + b.radians());
}

Angle operator-(Angle a, Angle b) noexcept {
  return a.made_from_degrees() && b.made_from_degrees() ? degrees(a.degrees() - b.degrees()) : radians(a.radians() - b.radians());
}

Angle operator-(Angle a) noexcept { return Angle() - a; }

Angle half(Angle a) noexcept { return a.made_from_degrees() ? degrees(a.degrees() / 2) : radians(a.radians() / 2); }

Angle angle_of(double y, double x) noexcept { return radians(std::atan2(y, x)); }

}  // namespace gonio
