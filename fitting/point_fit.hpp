// SPDX-License-Identifier: BSD-3-Clause
// The best values of a fit without anything around them, as its weights are being found.
#pragma once

#include <optional>
#include <vector>

#include "fitting/global_search.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {

/// Fits the same terms again and again while somebody else changes their weights. A global search finds the nonlinear parameters on a part
/// of many rows, good to a few standard uncertainties of all; the linear ones are always those of all rows.
class PointFit {
 public:
  /// Both must outlive this.
  PointFit(const Terms& terms, const SolveOptions& options);

  /// Fitted values [1/sr], [channel][row], at the lowest minimum; none where the cost is finite nowhere. A search that is not `global`
  /// descends from the last minimum.
  std::optional<std::vector<std::vector<double>>> operator()(bool global);

  /// The minimum of the last call; null before the first and where there is none.
  const Minimum* last() const noexcept { return minima_.empty() ? nullptr : &minima_.front(); }
  /// That and the others of the last global search, which looked at a part of many rows.
  const std::vector<Minimum>& minima() const noexcept { return minima_; }

 private:
  const Terms& terms_;
  const SolveOptions& options_;
  SearchSpace space_;
  std::vector<Minimum> minima_;
};

/// f̂ [1/sr] of every row in every channel.
std::vector<std::vector<double>> fitted_values(const Terms& terms, const std::vector<std::vector<double>>& linear,
                                               const std::vector<double>& theta);

}  // namespace gonio::fitting
