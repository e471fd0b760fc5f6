// SPDX-License-Identifier: BSD-3-Clause
// Files of known truth and known noise, for timing: a MERL table and a goniometer's CSV of blinn-phong-ngan.
#pragma once

#include <array>
#include <filesystem>

namespace gonio::bench {

/// f = ρd/π + ρs (s+2)/(2π) cos^s θh per channel, with normal noise of u = 1 % of f and 1e-4 1/sr in quadrature.
struct SyntheticMaterial {
  std::array<double, 3> rho_d{0.20, 0.15, 0.10};
  double rho_s = 0.30, s = 2000;
  unsigned long long seed = 20260701;
};

/// 90 x 90 x 180 cells at the centres of the cells, -1 where a direction is below the horizon; with the sidecar that says so.
void write_merl_file(const std::filesystem::path& path, const SyntheticMaterial& material);
/// 9 incidences (0 to 80°) x 36 zenith angles (0 to 87.5°) x 36 azimuths: 11 664 samples x 3, without uncertainties.
void write_csv_file(const std::filesystem::path& path, const SyntheticMaterial& material);

}  // namespace gonio::bench
