// SPDX-License-Identifier: BSD-3-Clause
// Where a model misses the data: standardised residuals by zenith angles.
#pragma once

#include <cstddef>
#include <vector>

#include "fitting/fit.hpp"

namespace gonio::fitting {

/// Residuals in one cell of incidence and outgoing zenith angle. Without noise beyond the stated, mean ± 1/√count is 0 and rms is 1.
struct ResidualCell {
  std::size_t count = 0;
  double mean = 0;  ///< of (f - f̂)/σ: a systematic miss
  double rms = 0;   ///< of the same: scatter beyond the noise
};

struct ResidualMap {
  static constexpr double step_deg = 10;
  static constexpr std::size_t steps = 9;

  /// [channel][i · steps + o], theta_i in [i, i + 1) · step_deg and theta_o in [o, o + 1) · step_deg; 90° belongs to the last.
  std::vector<std::vector<ResidualCell>> channel;
  std::size_t n_observations = 0;  ///< samples looked at
};

/// σ is u where the fit used it, else the variance model of the fit, else the root mean square of the channel's residuals. Outliers that
/// were left out are in none of the cells. Beyond 2^18 samples an even stride of about 2^15 of them is looked at.
/// The model is taken at the nominal directions, without a mean over apertures.
ResidualMap residual_map(const Observations& observations, const FitResult& result, int threads);

}  // namespace gonio::fitting
