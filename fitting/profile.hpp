// SPDX-License-Identifier: BSD-3-Clause
// The cost as a function of the exponent alone, the linear parameters eliminated.
#pragma once

#include <vector>

#include "fitting/linear_part.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// One channel at one exponent: its least cost, and the least-squares system of its linear parameters there (exact for the linear
/// metrics, linearised at the solution for the others). cost = |R x - rhs|² + rest.
struct ChannelPart {
  std::vector<double> x;
  SmallSystem system;
  double rest = 0;
  double cost = 0;
};

struct ProfilePoint {
  double s = 0;
  std::vector<ChannelPart> channel;
  double cost = 0;  ///< of all channels, the constants of collapsed blocks included
};

struct Minimum {
  double log_s = 0;
  ProfilePoint point;
};

/// Variable projection (Golub and Pereyra 1973, numerics D.1): for a given exponent the linear parameters are found by non-negative
/// least squares; for log, log1p and cbrt by Gauss-Newton steps of that kind, shortened until the cost falls.
class Profile {
 public:
  /// `held[c][k]`: the value of a linear parameter that is not fitted, NaN where it is.
  Profile(const Terms& terms, std::vector<std::vector<double>> held) : terms_(terms), held_(std::move(held)) {}

  ProfilePoint at(double s) const;
  /// The profile on 61 equal steps of log s over [1e-3, 1e9] (cut to the parameter's bounds).
  std::vector<ProfilePoint> scan(int threads) const;
  /// Every local minimum of a scan, refined by Brent's method (R. P. Brent, Algorithms for Minimization without Derivatives, 1973) to
  /// 1e-9 in log s; the lowest first. Ripples at the level of rounding are no minima; of a flat stretch the lower end counts.
  std::vector<Minimum> minima(const std::vector<ProfilePoint>& scan) const;

 private:
  ChannelPart channel_at(std::size_t channel, const std::vector<double>& columns) const;
  ChannelPart linearised(std::size_t channel, const std::vector<double>& columns, const std::vector<double>* about) const;
  double cost_of(std::size_t channel, const std::vector<double>& columns, const std::vector<double>& x) const;

  const Terms& terms_;
  std::vector<std::vector<double>> held_;
};

}  // namespace gonio::fitting
