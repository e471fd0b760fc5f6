// SPDX-License-Identifier: BSD-3-Clause
// From spectra to colours: the CIE 1931 standard observer under daylight, and linear sRGB.
#pragma once

#include <array>
#include <vector>

namespace gonio::tabulated {

/// Linear sRGB (primaries of ITU-R BT.709, white of D65) from tristimulus values with Y = 1 for the white: [row r, g, b][X, Y, Z].
const std::array<std::array<double, 3>, 3>& rgb_from_xyz();

/// Relative luminance Y of linear sRGB (ITU-R BT.709).
inline constexpr std::array<double, 3> luminance_of_rgb{0.2126, 0.7152, 0.0722};

/// Colour of a surface under daylight D65 for the CIE 1931 2° observer: linear sRGB as weights of the reflectances at these wavelengths
/// (increasing, nm), [r, g, b][wavelength]. The spectrum is taken as linear between the wavelengths and constant beyond the first and the
/// last. A surface that reflects everything is (1, 1, 1): each row of weights sums to 1. A saturated colour lies outside the primaries and
/// has a negative component.
///
/// Observer: CIE 018:2019 at steps of 5 nm from 360 to 830 nm. D65: CIE 015:2018 at steps of 10 nm, linear between.
std::array<std::vector<double>, 3> rgb_weights(const std::vector<double>& wavelengths_nm);

}  // namespace gonio::tabulated
