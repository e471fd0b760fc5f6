// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/residual_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/angle.hpp"
#include "fitting/robust.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t cells = ResidualMap::steps_in * ResidualMap::steps_out;
constexpr double side_rounding = 1e-9;  // of the product of sines: the plane between the two sides belongs to the mirror side

/// Cosines of the upper edges of every step but the last, falling.
std::array<double, ResidualMap::steps_in - 1> edges() {
  std::array<double, ResidualMap::steps_in - 1> out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = degrees(ResidualMap::step_deg * static_cast<double>(k + 1) - ResidualMap::below_deg).cos();
  return out;
}

std::size_t step_of(double cosine) {
  static const auto edge = edges();
  return static_cast<std::size_t>(std::partition_point(edge.begin(), edge.end(), [&](double e) { return cosine <= e; }) - edge.begin());
}

}  // namespace

std::uint16_t residual_cell(const LobeGeometry& g) noexcept {
  // cos of the angle between wi and wo is 2 cos² θd - 1 = cos θi cos θo + sin θi sin θo cos Δφ.
  const bool beside_light = 2 * g.cos_d * g.cos_d - 1 - g.cos_i * g.cos_o > side_rounding;
  const std::size_t out = step_of(g.cos_o), steps = ResidualMap::steps_in;
  return static_cast<std::uint16_t>(step_of(g.cos_i) * ResidualMap::steps_out + (beside_light ? steps - 1 - out : steps + out));
}

std::vector<ResidualCell> residual_cells(const std::vector<CellResidual>& residuals) {
  std::vector<ResidualCell> out(cells);
  for (const CellResidual& r : residuals) {
    const auto z = static_cast<double>(r.z);
    ResidualCell& cell = out[r.cell];
    ++cell.count, cell.mean += z, cell.rms += z * z;
  }
  for (ResidualCell& cell : out) {
    const double n = static_cast<double>(cell.count);
    if (n > 0) cell.mean /= n, cell.rms = std::sqrt(cell.rms / n);
  }
  return out;
}

std::vector<ResidualCell> clean_residual_cells(const std::vector<CellResidual>& residuals) {
  std::array<std::vector<double>, cells> by_cell;
  for (const CellResidual& r : residuals) by_cell[r.cell].push_back(static_cast<double>(r.z));
  std::vector<ResidualCell> out(cells);
  std::vector<double> scratch;
  for (std::size_t k = 0; k < cells; ++k) {
    if (by_cell[k].empty()) continue;
    const RobustMean mean = robust_mean(by_cell[k], Robust::automatic, scratch);
    out[k] = {mean.count, mean.mean, std::sqrt(mean.mean * mean.mean + mean.within / static_cast<double>(mean.count))};
  }
  return out;
}

}  // namespace gonio::fitting
