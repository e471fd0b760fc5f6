// SPDX-License-Identifier: BSD-3-Clause
// Text files of the ALTA library: a header of `#KEY value` lines, then one row per sample.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Understands `#DIM n m`, `#PARAM_OUT INV_STERADIAN` (f) or `INV_STERADIAN_COSINE_FACTOR` (f cos theta_o), and the parameterisations
///   ISOTROPIC_TL_TV_PROJ_DPHI  theta_i, theta_o cos dphi, theta_o sin dphi      (dphi = phi_o - phi_i, so +theta_i is the way back)
///   ISOTROPIC_TV_TL_DPHI       theta_o, theta_i, dphi
///   SPHERICAL_TL_PL_TV_PV      theta_i, phi_i, theta_o, phi_o
/// all in radians; L is the light, V the view. Masked as in CSV files; a row at theta_o = 90° has no f if the cosine is in the value.
/// Throws Error(input) with all faults: another parameterisation, vertical segments (`#VS` other than 0), the binary variant, a row with
/// a wrong number of values, text, an infinity, no sample left.
Dataset read_alta(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_alta(std::string_view head, std::uintmax_t size);
Opened open_alta(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
