// SPDX-License-Identifier: BSD-3-Clause
// Files of known truth and known noise, for timing: a MERL table and a goniometer's CSV.
#pragma once

#include <filesystem>

#include "brdf/analytic_brdf.hpp"

namespace gonio::bench {

/// f = ρd/π + ρs (s+2)/(2π) cos^s θh with ρd = .20, .15, .10 in red, green and blue and ρs = .30.
AnalyticBrdf blinn_phong(double s);
/// GGX with Schlick's reflectance, ρd = .20, .15, .10, F0 = .05, F90 = .9.
AnalyticBrdf ggx(double alpha);

/// 90 x 90 x 180 cells at the centres of the cells, -1 where the cosine of a direction is `least_cosine` or less; with the sidecar that
/// says so. Normal noise of 1 % of f and 1e-4 1/sr in quadrature, here and below.
void write_merl_file(const std::filesystem::path& path, const AnalyticBrdf& truth, double least_cosine = 0);
/// 9 incidences (0 to 80°) x 36 zenith angles (0 to 87.5°) x 36 azimuths: 11 664 samples x 3, without uncertainties.
void write_csv_file(const std::filesystem::path& path, const AnalyticBrdf& truth);

}  // namespace gonio::bench
