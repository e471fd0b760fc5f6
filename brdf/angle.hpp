// SPDX-License-Identifier: BSD-3-Clause
// An angle that knows its unit, its cosine and its sine.
#pragma once

namespace gonio {

/// An angle. Made by `radians()`, `degrees()` or `_deg`, never from a bare double.
///
/// Cosine and sine are kept, and an angle made from degrees takes them by exact reduction to [-45°, 45°] in degrees (through
/// the elevation near 90°): cos of 90° is exactly 0, and 89.99° loses no digit to the rounding of pi. Sums and differences of
/// two angles made from degrees are formed in degrees for the same reason. A non-finite angle is kept as it is (all NaN).
class Angle {
 public:
  constexpr Angle() = default;  ///< 0

  double radians() const noexcept { return radians_; }
  double degrees() const noexcept { return degrees_; }
  double cos() const noexcept { return cos_; }
  double sin() const noexcept { return sin_; }
  /// True if the angle was made from degrees (then `degrees()` is bit for bit what was given).
  bool made_from_degrees() const noexcept { return from_degrees_; }

  static Angle from_radians(double value) noexcept;
  static Angle from_degrees(double value) noexcept;

 private:
  double radians_ = 0, degrees_ = 0, cos_ = 1, sin_ = 0;
  bool from_degrees_ = true;
};

inline Angle radians(double value) noexcept { return Angle::from_radians(value); }
inline Angle degrees(double value) noexcept { return Angle::from_degrees(value); }
inline Angle operator""_deg(long double value) noexcept { return Angle::from_degrees(static_cast<double>(value)); }
inline Angle operator""_deg(unsigned long long value) noexcept { return Angle::from_degrees(static_cast<double>(value)); }

/// In degrees if both operands were made from degrees, in radians otherwise.
Angle operator+(Angle a, Angle b) noexcept;
Angle operator-(Angle a, Angle b) noexcept;
Angle operator-(Angle a) noexcept;
/// Half the angle; exact.
Angle half(Angle a) noexcept;
/// The angle of a point (x, y), in (-180°, 180°]; 0 for the origin.
Angle angle_of(double y, double x) noexcept;

}  // namespace gonio
