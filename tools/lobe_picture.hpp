// SPDX-License-Identifier: BSD-3-Clause
// The picture of a fit: measured points with error bars over the fitted lobe in the plane of incidence.
#pragma once

#include <filesystem>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::tools {

/// Draws a PNG of 1400 x 1000 pixels with gnuplot: above, f over the signed zenith angle of the outgoing direction (positive on the
/// specular side) for every incidence with samples in its plane; below, measured over fitted minus one with k = 2 error bars.
/// Error(input) if gnuplot is not to be had or fails, or if no sample lies in the plane of incidence.
void draw_lobe(const Dataset& samples, const AnalyticBrdf& fitted, const std::filesystem::path& png);

}  // namespace gonio::tools
