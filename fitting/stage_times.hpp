// SPDX-License-Identifier: BSD-3-Clause
// Where the time of a fit goes.
#pragma once

#include <chrono>
#include <utility>

namespace gonio::fitting {

/// Wall time of the stages of a fit [s]. Nothing depends on it.
struct StageTimes {
  double collapse_s = 0;   ///< samples to the rows that are fitted, or to the sums of a large table
  double weights_s = 0;    ///< weights from the scatter, wrong readings and means over apertures, with the fits that these take
  double scan_s = 0;       ///< every minimum over the nonlinear parameters, polished
  double intervals_s = 0;  ///< covariance, profile intervals and what is determined
  double errors_s = 0;     ///< root mean squares under every metric
};

/// Times one stage after another.
class Laps {
 public:
  /// Seconds since the last call, at first since it was made.
  double operator()() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace gonio::fitting
