// SPDX-License-Identifier: BSD-3-Clause
// Goniometric and Rusinkiewicz (half/difference) coordinates of a pair of directions, in their stable forms.
#pragma once

#include "brdf/direction.hpp"

namespace gonio {

/// A pair of directions as a goniometer names it: zenith angles from the normal, azimuths counter-clockwise seen from +z,
/// both directions away from the surface. Mirror reflection is phi_o = phi_i + 180°. theta < 0 means (|theta|, phi + 180°).
struct GonioAngles {
  Angle theta_i, phi_i, theta_o, phi_o;

  Direction wi() const noexcept { return Direction::spherical(theta_i, phi_i); }
  Direction wo() const noexcept { return Direction::spherical(theta_o, phi_o); }
};

/// The goniometric angles of two directions; theta in [0, 180°], phi in (-180°, 180°].
GonioAngles gonio_angles(const Direction& wi, const Direction& wo) noexcept;

/// Rusinkiewicz coordinates (Rusinkiewicz, "A New Change of Variables for Efficient BRDF Representation", EGWR 1998):
/// h = (wi + wo)/|wi + wo| is (theta_h, phi_h), and wi seen in the frame of h is (theta_d, phi_d).
/// phi_h is arbitrary at theta_h = 0 and phi_d at theta_h = 0 or theta_d = 0: nothing may depend on them there.
struct HalfDifference {
  Angle theta_h, phi_h, theta_d, phi_d;
};

/// From angles, with the products of sines that keep every digit for grazing and nearly mirrored pairs
/// (design: sum-to-product forms; no half vector, no acos). Differences of azimuths are exact for angles made from degrees.
/// If wi + wo = 0 (both grazing and opposite) theta_h is 0 and theta_d 90°.
HalfDifference half_difference(const GonioAngles& angles) noexcept;
/// From vectors; theta_d = atan2(|wi - wo|, |wi + wo|). Loses digits only where the vectors themselves already have.
HalfDifference half_difference(const Direction& wi, const Direction& wo) noexcept;

struct DirectionPair {
  Direction wi, wo;
};
/// The inverse: rotate d and its mirror image by theta_h about y, then by phi_h about z.
DirectionPair directions(const HalfDifference& coordinates) noexcept;

/// phi_d folded into [0, pi) by reciprocity, as MERL stores it.
double fold_phi_d(double phi_d_radians) noexcept;

}  // namespace gonio
