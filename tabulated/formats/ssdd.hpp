// SPDX-License-Identifier: BSD-3-Clause
// Surface scattering distribution data: .ssdd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// "Surface scattering distribution data (SSDD) file format", version 0.3, 2026 (the documentation of libbsdf): a header, then up to four
/// blocks of key words and numbers in text or little-endian float32, the first angle fastest, f in 1/sr, cosine not included. Read are
/// blocks `brdf` and `btdf` in spherical, specular, half-difference and distorted spherical coordinates (the last as libbsdf has them,
/// distorted_angles.hpp: the document does not give their formula), all colour models and both reductions. A file with both gives the
/// brdf, `--assume data_type=btdf` the other; specular reflectances and transmittances stand in `info`, not in the BRDF.
/// Throws Error(input) with all faults by line, or byte in binary numbers.
Opened open_ssdd(const std::filesystem::path& path, const ReadOptions& options);
bool recognises_ssdd(std::string_view head, std::uintmax_t size);

/// Half-difference coordinates (theta_h as the squares of even steps, dense near the peak; theta_d; phi_d folded if the source is
/// bilateral), numbers as text. A file of this format is written on its own grid. Nodes beyond the horizon and unknown ones repeat their
/// neighbour, because readers interpolate with every number; negative values stay.
ExportNotes write_ssdd(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same with binary numbers.
ExportNotes write_ssdd_binary(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same in spherical, in specular and in distorted spherical coordinates, as text.
ExportNotes write_ssdd_spherical(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_ssdd_specular(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_ssdd_distorted(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
