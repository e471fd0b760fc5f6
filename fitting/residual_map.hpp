// SPDX-License-Identifier: BSD-3-Clause
// Where a model misses the data: standardised residuals by direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "brdf/lobe_geometry.hpp"

namespace gonio::fitting {

/// Residuals z of one cell. Of the right model with the right noise, mean ± 1/√count is 0 and rms is 1.
struct ResidualCell {
  std::size_t count = 0;
  double mean = 0;  ///< a systematic miss
  double rms = 0;   ///< scatter beyond the noise
};

/// Residuals z = (f - f̂)/σ of a fit over incident zenith angle and outgoing zenith angle, the latter negative on the side of the light
/// (azimuths less than 90° apart) and positive on the side of the mirror direction. σ is u where the fit weighed by it, else the
/// variance model of the fit; where it had neither, z is the residual of the metric over its root mean square in the channel.
struct ResidualMap {
  static constexpr double step_deg = 10;
  static constexpr std::size_t steps_in = 9, steps_out = 18;
  /// Edges lie this far below the multiples of the step, so that directions meant to be at one fall into one cell.
  static constexpr double below_deg = 0.25;

  bool sigma_known = false;                        ///< z is in units of the noise, not of its own root mean square
  std::vector<std::vector<ResidualCell>> channel;  ///< [channel][in · steps_out + out]; empty if nothing was fitted
  std::size_t n_samples = 0;                       ///< looked at, in the channel with most of them

  /// Middle of a cell, to below_deg.
  static double theta_i_deg(std::size_t cell) noexcept { return step_deg * (static_cast<double>(cell / steps_out) + 0.5); }
  static double theta_o_deg(std::size_t cell) noexcept {
    return step_deg * (static_cast<double>(cell % steps_out) + 0.5) - step_deg * static_cast<double>(steps_in);
  }
};

/// The cell of a sample above the horizon.
std::uint16_t residual_cell(const LobeGeometry& geometry) noexcept;

/// A residual and its cell.
struct CellResidual {
  std::uint16_t cell = 0;
  float z = 0;
};

/// The cells of one channel.
std::vector<ResidualCell> residual_cells(const std::vector<CellResidual>& residuals);
/// The same where wrong readings may be among them: those far from the others of their cell count in none.
std::vector<ResidualCell> clean_residual_cells(const std::vector<CellResidual>& residuals);

}  // namespace gonio::fitting
