// SPDX-License-Identifier: BSD-3-Clause
// Tabulated scatter of FRED (.txt).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// `type bsdf_data`, `format angles=deg|sin bsdf=value|log scale=NUMBER`, then per specular direction a line of two numbers and lines of
/// three: scatter direction and f [1/sr] or log10 f, times `scale` (FRED's help, "Tabulated BSDF"). deg: zenith angle, negative on the
/// other side of the normal, and azimuth; sin: direction cosines sin(phi) sin(theta), cos(phi) sin(theta). Trap: the direction given is
/// the specular one, so phi_i is half a turn from it.
/// One specular azimuth means an isotropic sample; FRED's model is then bilateral too, which is said of samples on one side of the plane.
/// A file does not say whether it holds reflection or transmission: it is taken for reflection unless `--assume side=transmission`.
/// Throws Error(input) with all faults.
Dataset read_fred(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_fred(std::string_view head, std::uintmax_t size);
Opened open_fred(const std::filesystem::path& path, const ReadOptions& options);

/// The samples of the source as they are, incidences in increasing order; without samples its values at `incidence_grid`, azimuths about
/// the specular direction in steps of 15, 10 or 5° (half a turn for bilateral sources) and 32, 64 or 128 radial angles. FRED wants positive
/// values: what is unknown or not positive is left out. One channel: of colours the luminance.
ExportNotes write_fred(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
