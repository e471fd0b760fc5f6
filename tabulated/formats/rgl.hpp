// SPDX-License-Identifier: BSD-3-Clause
// `.bsdf` files of the RGL material database: RGB and spectral, isotropic and anisotropic.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"
#include "tabulated/rgl_table.hpp"

namespace gonio::tabulated {

/// Reads the arrays of a file; a file with both `rgb` and `spectra` gives the spectra. Throws Error(input) with all faults: a damaged
/// container, a field that is missing or has another type or shape than the readers of the format insist on, angles or wavelengths that do
/// not increase, numbers that are not finite, densities below 0, a slice without any density, a missing Jacobian.
///
/// The mask `valid` is not used: it only repeats which nodes lie above the horizon, and files differ in what a set bit means.
RglArrays read_rgl(const std::filesystem::path& path);

bool recognises_rgl(std::string_view head, std::uintmax_t size);
/// As a table; its nodes are made into samples when the observations are first read.
Opened open_rgl(const std::filesystem::path& path, const ReadOptions& options);

/// Writes arrays as they are; one of `rgb` and `spectra` by the channels, which are r, g, b or have increasing wavelengths. All or nothing.
void write_rgl(const RglArrays& arrays, const std::filesystem::path& path);

/// Any BRDF as an RGB file, resolution by `options.size` (8 x 32 x 32, 32 x 64 x 64 or 64 x 128 x 128 incidences and values if the source
/// is isotropic) or `options.error`. The arrays of a table of the same kind are written as they are: nothing is resampled.
ExportNotes write_rgl_rgb(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same with a spectrum: renderers take RGB files in their RGB modes only, and spectral ones in the others.
ExportNotes write_rgl_spectral(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
