// SPDX-License-Identifier: BSD-3-Clause
// Where to sample a BRDF for lists of samples that scatter programs read.
#pragma once

#include <vector>

#include "brdf/coordinates.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Above the horizon: `incidence_grid`, azimuths about the specular direction in steps of 15, 10 or 5° (0 to 180° for bilateral sources),
/// 32, 64 or 128 radial angles of `radial_grid`; the specular direction once. Anisotropic sources at 12 azimuths of the light.
std::vector<GonioAngles> specular_poses(const Opened& source, const WriteOptions& options);

}  // namespace gonio::tabulated
