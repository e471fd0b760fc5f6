// SPDX-License-Identifier: BSD-3-Clause
// Smooth reflectance spectra for colours.
#pragma once

#include <array>
#include <cstddef>

namespace gonio::tabulated {

/// Spectra of the three primaries of linear sRGB; the spectrum of a colour is r · red + g · green + b · blue. They are smooth, lie in
/// [0, 1] and sum to 1 at every wavelength, so that grey is a constant spectrum and a colour in [0, 1] never reflects more than it gets.
/// Seen under D65 (`rgb_weights`) each gives back its primary. The map is linear: it goes for values of any size, and before or after
/// interpolation alike.
///
/// The idea is that of Mallett and Yuksel, "Spectral Primary Decomposition for Rendering with sRGB Reflectance", EGSR 2019. Ours are the
/// spectra with the least sum of squared steps under these constraints, on 360 to 830 nm every 10 nm, linear between.
struct PrimarySpectra {
  static constexpr std::size_t count = 48;
  static constexpr double first_nm = 360, step_nm = 10;
  static const std::array<std::array<double, count>, 3>& values();  ///< [r, g, b][wavelength]
};

}  // namespace gonio::tabulated
