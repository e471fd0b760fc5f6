// SPDX-License-Identifier: BSD-3-Clause
// Scatter data as ASTM E1392 and E2387 write them (.astm).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Free header lines, `NUM_POINTS n`, `VARS theta_i,phi_i,theta_s,phi_s,...`, then a line per sample, separated by commas, angles in
/// radians, values f [1/sr]. Columns: R, G, B, or X, Y, Z, or `550nm` …, or any name. Trap: in the standard the specular direction is phi_s
/// - phi_i = 0, files in circulation (Cornell's) and their readers (libbsdf, ALTA) have it at pi, and no file says: `--assume
/// specular=0|pi` (files of ours say it). theta_s < 0 means the other side of the normal, > pi/2 is masked in reflection; `--assume
/// side=transmission` says that the file holds transmission, theta_s counting from the other side's normal if it does not exceed pi/2.
/// Throws Error(input) with all faults.
Dataset read_astm(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_astm(std::string_view head, std::uintmax_t size);
Opened open_astm(const std::filesystem::path& path, const ReadOptions& options);

/// The samples of the source as they are, without samples its values on `direction_grid`; specular at pi, which a header line says.
ExportNotes write_astm(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
