// SPDX-License-Identifier: BSD-3-Clause
// Measured BSDFs of NVIDIA's Material Definition Language: .mbsdf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// NVIDIA Material Definition Language 1.10 specification, appendix B: a line `NVIDIA ARC MBSDF V1`, lines key="value", then blocks
/// `MBSDF_DATA=` or `MBSDF_DATA_REFLECTION=`, `MBSDF_DATA_TRANSMISSION=`, each with three little-endian uint32 (0 scalar or 1 RGB, number
/// of zenith angles n, number of azimuths m) and float32 [theta_i][theta_o][azimuth][channel] in 1/sr, cosine not included. Zenith angles
/// divide 0 to 90°, azimuths |phi_o - phi_i| from 0 (the way back) to 180° (mirror) evenly; a value belongs to the centre of its cell:
/// (k + 1/2) / n. `--assume nodes=left` puts it at k / n, as the processor's (not the graphics card's) evaluation in the SDK does.
/// A file with both blocks gives the reflection, `--assume part=transmission` the other.
///
/// Values are given as stored, negative ones included. MDL renderers clamp them and take the mean of f(wi, wo) and f(wo, wi).
/// Throws Error(input) with all faults by byte.
Opened open_mbsdf(const std::filesystem::path& path, const ReadOptions& options);
bool recognises_mbsdf(std::string_view head, std::uintmax_t size);

/// 45 x 45 x 90, 90 x 90 x 90 or 180 x 180 x 180 cells (paper, standard, fine) in three channels r, g, b, or in one. Unknown cells are 0.
/// Throws Error(input) for an anisotropic source.
ExportNotes write_mbsdf(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
