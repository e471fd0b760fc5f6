// SPDX-License-Identifier: BSD-3-Clause
// Unit vectors that belong to a frame.
#pragma once

#include <cmath>

#include "brdf/angle.hpp"

namespace gonio {

/// The frame of the sample: z is the surface normal, x and y lie in the surface, azimuths run counter-clockwise seen from +z.
struct SampleFrame {};
/// The frame of the bench: z points up through the pivot, x is the direction every axis calls zero azimuth.
struct BenchFrame {};

/// A unit 3-vector in one frame. Vectors of different frames do not mix: there is no operation that takes both.
/// In a pair (wi, wo) both point *away* from the surface: wi to the light, wo to the detector.
template <class Frame>
class UnitVector {
 public:
  constexpr UnitVector() = default;  ///< +z

  /// The direction of (x, y, z). Throws Error(input) if it is zero or not finite.
  static UnitVector normalized(double x, double y, double z);
  /// Trusts that x² + y² + z² = 1 to rounding; for results of rotations.
  static constexpr UnitVector trusted(double x, double y, double z) noexcept {
    UnitVector v;
    v.x_ = x, v.y_ = y, v.z_ = z;
    return v;
  }
  /// Zenith angle theta from +z, azimuth phi from +x. A negative theta means (|theta|, phi + 180°), which this gives by itself.
  static UnitVector spherical(Angle theta, Angle phi) noexcept {
    return trusted(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
  }

  double x() const noexcept { return x_; }
  double y() const noexcept { return y_; }
  double z() const noexcept { return z_; }
  /// Zenith angle in [0, 180°], from atan2 (never acos: it loses half the digits near 0).
  Angle theta() const noexcept { return angle_of(std::hypot(x_, y_), z_); }
  /// Azimuth in (-180°, 180°].
  Angle phi() const noexcept { return angle_of(y_, x_); }

  friend constexpr bool operator==(const UnitVector&, const UnitVector&) = default;

 private:
  double x_ = 0, y_ = 0, z_ = 1;
};

using Direction = UnitVector<SampleFrame>;

template <class Frame>
double dot(const UnitVector<Frame>& a, const UnitVector<Frame>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// The angle between two directions, 2 atan2(|a-b|, |a+b|): full precision at 0 and at 180°.
template <class Frame>
Angle angle_between(const UnitVector<Frame>& a, const UnitVector<Frame>& b) noexcept {
  const double minus = std::hypot(a.x() - b.x(), a.y() - b.y(), a.z() - b.z());
  const double plus = std::hypot(a.x() + b.x(), a.y() + b.y(), a.z() + b.z());
  return radians(2 * std::atan2(minus, plus));
}

extern template class UnitVector<SampleFrame>;
extern template class UnitVector<BenchFrame>;

}  // namespace gonio
