// SPDX-License-Identifier: BSD-3-Clause
// The variance of one reading of the power meter.
#pragma once

#include <string>
#include <vector>

#include "acquisition/bench.hpp"

namespace gonio::acquisition {

/// Repeated readings of one thing, taken one after the other.
struct RepeatedReadings {
  std::vector<double> signals;  ///< [W]
  double exposure_s = 0;
};

/// var(S) = read² + S/(k t) + (last digit)²/12: read noise, shot noise of k photo-electrons per joule, rounding of what the meter prints.
class NoiseModel {
 public:
  /// What the lab states (bench file, `detector.noise`).
  NoiseModel(const MeterNoise& stated, double range_w);
  /// From the spread within visits: read noise from the dark readings, shot noise from what the reference scatters more than that.
  /// Either is unknown (NaN) with fewer than five readings in visits of at least two, and where nothing scatters.
  NoiseModel(const std::vector<RepeatedReadings>& dark, const std::vector<RepeatedReadings>& reference);

  double variance(double signal_w, double exposure_s) const {
    return variance_without_shot(signal_w) + shot_variance(signal_w, exposure_s);
  }
  double variance_without_shot(double signal_w) const;
  double shot_variance(double signal_w, double exposure_s) const;
  /// `stated`, `estimated from repeated readings` or `unknown`.
  const std::string& origin() const { return origin_; }

 private:
  double read_variance_ = 0;       // W²
  double joule_per_electron_ = 0;  // 1/k
  int digits_ = 0;                 // 0: rounding is part of the estimated read noise
  double range_w_ = 0;
  std::string origin_;
};

}  // namespace gonio::acquisition
