// SPDX-License-Identifier: BSD-3-Clause
// A sample that does not stand as the angles say: a tilted normal, an azimuth that is off.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "brdf/coordinates.hpp"
#include "brdf/lobe_geometry.hpp"

namespace gonio::fitting {

/// All in radians, small.
struct Misalignment {
  double tilt_x = 0;   ///< the true normal leans by this towards +x
  double tilt_y = 0;   ///< and by this towards +y
  double azimuth = 0;  ///< the true azimuth difference phi_o - phi_i is larger by this

  static constexpr std::size_t size = 3;
  static constexpr std::array<std::string_view, size> names{"tilt_x", "tilt_y", "azimuth"};
  double& operator[](std::size_t k) { return k == 0 ? tilt_x : k == 1 ? tilt_y : azimuth; }
  bool none() const noexcept { return tilt_x == 0 && tilt_y == 0 && azimuth == 0; }
};

/// The geometry in the true frame of the sample: wo turned about the normal by the azimuth, then both directions seen from the tilted
/// normal. Without misalignment bit for bit that of the angles.
/// Trap: only the directions are corrected. A reduction that divided by the cosine of the nominal angle keeps that error, of the order
/// of tilt · tan θ.
LobeGeometry lobe_geometry(const GonioAngles& angles, const Misalignment& misalignment) noexcept;

}  // namespace gonio::fitting
