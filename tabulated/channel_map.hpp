// SPDX-License-Identifier: BSD-3-Clause
// From the channels a source has to those a file wants.
#pragma once

#include <string>
#include <vector>

#include "brdf/channels.hpp"

namespace gonio::tabulated {

/// A linear map between channels, so that it may be applied before or after interpolation, to f as to anything proportional to f.
struct ChannelMap {
  Channels to;
  std::vector<double> weights;  ///< [to · from_count + from]
  std::string changed;          ///< one sentence on what the map does to the data, for `ExportNotes::lost`; empty if nothing is changed

  /// `out` has one value per channel of `to`; `in` one per channel of the source. A NaN in makes NaN.
  void apply(const double* in, double* out) const;
};

/// To linear `r, g, b`: as they are; X, Y, Z (Y = 1 for a white surface under D65) by the matrix of sRGB; one channel copied to all three;
/// spectra as seen under D65 by the CIE 1931 observer. Throws Error(input) for other channels.
ChannelMap map_to_rgb(const Channels& from);
/// To wavelengths in increasing order: as they are; red, green and blue by smooth spectra (tabulated/rgb_to_spectrum.hpp); one channel as a
/// constant from 360 to 830 nm. Throws Error(input) for other channels, for fluorescence and for a wavelength that occurs twice.
ChannelMap map_to_spectrum(const Channels& from);
/// To tristimulus values X, Y, Z with Y = 1 for a white surface under D65: as they are; what `map_to_rgb` takes, by the matrix of sRGB.
ChannelMap map_to_xyz(const Channels& from);
/// To one channel Y, the luminance relative to a white surface under D65.
ChannelMap map_to_luminance(const Channels& from);

}  // namespace gonio::tabulated
