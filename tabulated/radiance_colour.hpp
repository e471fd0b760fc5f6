// SPDX-License-Identifier: BSD-3-Clause
// Red, green and blue as Radiance means them, and CIE XYZ.
#pragma once

#include <array>

namespace gonio::tabulated {

/// Radiance's primaries, x and y of red (0.640, 0.330), green (0.290, 0.600), blue (0.150, 0.060), and its white of equal energy: grey
/// has X = Y = Z, and Y = 0.265 r + 0.670 g + 0.065 b (G. Ward Larson, R. Shakespeare, "Rendering with Radiance", 1998). Trap: sRGB's
/// white is D65; its numbers taken as these keep greys grey and shift saturated colours a little.
std::array<double, 3> xyz_of_rgb(const std::array<double, 3>& rgb) noexcept;
std::array<double, 3> rgb_of_xyz(const std::array<double, 3>& xyz) noexcept;

/// CIE 1976 u' and v' of a colour; those of white for black.
std::array<double, 2> uv_of_xyz(const std::array<double, 3>& xyz) noexcept;
/// The colour of luminance Y at u', v'. v' must be positive.
std::array<double, 3> xyz_of_yuv(double luminance, double u, double v) noexcept;

}  // namespace gonio::tabulated
