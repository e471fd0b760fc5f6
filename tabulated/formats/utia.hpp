// SPDX-License-Identifier: BSD-3-Clause
// Tables of the UTIA BRDF database: .bin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Bytes of a file: three planes of 288 x 288 numbers in double precision.
inline constexpr std::uintmax_t utia_file_size = 3 * 288 * 288 * sizeof(double);

/// J. Filip and R. Vávra, "Template-Based Sampling of Anisotropic BRDFs", Computer Graphics Forum 33(7), 2014: anisotropic, 1 990 656 bytes
/// without a header, little-endian float64 [r, g, b][theta_i, phi_i][theta_o, phi_o], zenith angles 0 to 75° by 15°, azimuths by 7.5°.
///
/// **What the numbers are, programs do not agree on**, so `--assume values=` has to say it: `f` takes them as they are (ALTA), `display`
/// as 140 times the sRGB code of f/100, negative ones as 0 (dj_brdf; with its threshold of 0.0375). Linear between nodes; beyond 75° the
/// last ring holds. Throws Error(input) with all faults by byte.
Opened open_utia(const std::filesystem::path& path, const ReadOptions& options);
/// By the size, and by numbers that could be ones of a BRDF.
bool recognises_utia(std::string_view head, std::uintmax_t size);

/// Values f as they are, unknown ones as 0; the grid is the format's, coarse for anything glossy.
ExportNotes write_utia(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same coded for display; negative values become 0.
ExportNotes write_utia_display(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
