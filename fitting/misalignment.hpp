// SPDX-License-Identifier: BSD-3-Clause
// A sample that does not stand as the angles say: a tilted normal, a turned surface.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "brdf/coordinates.hpp"
#include "brdf/lobe_geometry.hpp"

namespace gonio::fitting {

/// All in radians, small, in the frame in which the angles are stated. Tilt and azimuth together are the rotation that the sample
/// has made since the frame was laid out.
struct Misalignment {
  double tilt_x = 0;   ///< the true normal leans by this towards +x (azimuth 0)
  double tilt_y = 0;   ///< and by this towards +y (azimuth 90°)
  double azimuth = 0;  ///< the surface is turned by this about its normal, counter-clockwise: both true azimuths are smaller by it

  static constexpr std::size_t size = 3;
  static constexpr std::array<std::string_view, size> names{"tilt_x", "tilt_y", "azimuth"};
  double& operator[](std::size_t k) { return k == 0 ? tilt_x : k == 1 ? tilt_y : azimuth; }
  bool none() const noexcept { return tilt_x == 0 && tilt_y == 0 && azimuth == 0; }
};

/// The same pair of directions in the true frame of the sample. A direction above the stated horizon that lies below the true one is
/// taken at the true horizon. Without misalignment bit for bit the angles.
/// Trap: only the directions are corrected. A reduction that divided by the cosine of the nominal angle keeps that error, of the order
/// of tilt · tan θ.
GonioAngles seen_by(const Misalignment& misalignment, const GonioAngles& angles) noexcept;

/// The geometry of these. Without misalignment bit for bit that of the angles.
LobeGeometry lobe_geometry(const GonioAngles& angles, const Misalignment& misalignment) noexcept;

}  // namespace gonio::fitting
