// SPDX-License-Identifier: BSD-3-Clause
// Tables of the UTIA BRDF database: .bin and .exr.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Bytes of a .bin: three planes of 288 x 288 numbers in double precision.
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

/// The same table as an OpenEXR picture of 288 x 288 pixels R, G, B, float or half: a row per (theta_i, phi_i), from the top, a column per
/// (theta_o, phi_o), as ALTA has it. The same question, the same answers. Throws Error(input) with all faults by pixel.
Opened open_utia_exr(const std::filesystem::path& path, const ReadOptions& options);
/// By the size of the picture and its channels, if it is none of our own kinds. Any RGB picture of that size is taken for a table; that it
/// cannot be read without an answer is the guard.
bool recognises_utia_exr(std::string_view head, std::uintmax_t size);

/// Values f as they are, unknown ones as 0; the grid is the format's, coarse for anything glossy.
ExportNotes write_utia(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same coded for display; negative values become 0.
ExportNotes write_utia_display(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// Values f as float32 pixels.
ExportNotes write_utia_exr(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
