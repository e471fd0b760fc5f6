// SPDX-License-Identifier: BSD-3-Clause
// Text files of the ALTA library: a header of `#KEY value` lines, then one row per sample.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Understands `#DIM n m`, `#PARAM_OUT INV_STERADIAN` or `RGB_COLOR` (f) or `INV_STERADIAN_COSINE_FACTOR` (f cos theta_o), and the
/// parameterisations
///   ISOTROPIC_TL_TV_PROJ_DPHI  theta_i, theta_o cos dphi, theta_o sin dphi      (dphi = phi_o - phi_i, so +theta_i is the way back)
///   ISOTROPIC_TV_TL_DPHI       theta_o, theta_i, dphi
///   SPHERICAL_TL_PL_TV_PV      theta_i, phi_i, theta_o, phi_o
///   RUSIN_TH_TD_PD             theta_h, theta_d, phi_d
///   RUSIN_TH_PH_TD_PD          theta_h, phi_h, theta_d, phi_d
///   RUSIN_TH_TD                theta_h, theta_d; phi_d of the slice is asked for (`--assume phi_d_deg=90`)
///   COS_TH                     the cosine of theta_h; theta_d and phi_d of the slice are asked for
/// angles in radians; L is the light, V the view. Masked as in CSV files; a row at theta_o = 90° has no f if the cosine is in the value.
/// Throws Error(input) with all faults: another parameterisation, vertical segments (`#VS` other than 0), the binary variant, a row with
/// a wrong number of values, text, an infinity, no sample left.
Dataset read_alta(const std::filesystem::path& path, const ReadOptions& options);

/// The samples with `#PARAM_IN ISOTROPIC_TV_TL_DPHI` if they are isotropic, else SPHERICAL_TL_PL_TV_PV; channels r, g, b as RGB_COLOR. Rows
/// with an unknown value are left out, angles are rounded once to radians. Throws Error(input) for transmission.
ExportNotes write_alta(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// The same with `#PARAM_IN RUSIN_TH_TD_PD`, for isotropic sources.
ExportNotes write_alta_half(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

bool recognises_alta(std::string_view head, std::uintmax_t size);
Opened open_alta(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
