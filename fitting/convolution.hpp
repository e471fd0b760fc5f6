// SPDX-License-Identifier: BSD-3-Clause
// Rows of a fit whose model value is the mean over the apertures, and the decision where that is called for.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "brdf/aperture.hpp"
#include "brdf/observations.hpp"

namespace gonio::fitting {

struct Terms;

/// Rows that stand for the mean of the model over several geometries.
struct MeanRows {
  std::vector<std::size_t> row;        ///< ascending
  std::vector<ApertureRule> rule;      ///< of every one of them
  std::vector<std::size_t> first;      ///< nodes [first[k], first[k + 1]) belong to row[k]; one more than rows, or empty
  std::vector<LobeGeometry> geometry;  ///< of the nodes
  std::vector<double> weight;          ///< of the nodes; 1 in all for every row

  bool empty() const noexcept { return row.empty(); }
  void append(std::size_t number, const ApertureRule& by, std::span<const LobeGeometry> nodes, std::span<const double> weights);
  /// The same with sample[row] for every row.
  MeanRows renumbered(std::span<const std::size_t> sample) const;
  /// Row j of the result is row rows[j] of these where that is a mean.
  MeanRows of(std::span<const std::size_t> rows) const;
};

/// Whether a fit took means over the apertures, and why.
struct ApertureEffect {
  bool on = false;
  std::string reason;         ///< one sentence
  double bound = 0;           ///< no parameter moves by more than this many of its standard uncertainties if the apertures are left out
  std::size_t n_samples = 0;  ///< for which means were taken
};

/// Looks at what the mean over the apertures changes at the solution (linear, theta), in standard deviations of every reading: z. Leaving
/// it out moves no parameter by more than √Σz² of its standard uncertainty (least squares: |δ_k|/σ_k <= |z|), whatever the lobe; that is
/// s a²/4 of the peak for a mirror lobe (measurement.md 1). Below 0.1 nothing is done. Else the rows with the largest z become means
/// until those left are together below 0.03, with disc rules of growing order until the last step changes less than 0.03; `reason` says
/// what that step changes where there is no finer rule. Trap: a disc that the horizon cuts in the midst of a lobe settles slowly; with both
/// directions within the aperture of the horizon a mean is good for 1 % of itself. Rows that are means already stay so. `weight`:
/// [channel][row] 1/σ² of a reading, of those too that the fit left out as wrong: without the means they may only have looked so.
ApertureEffect convolve(Terms& terms, const Observations& observations, const std::vector<std::vector<double>>& linear,
                        const std::vector<double>& theta, const std::vector<std::vector<double>>& weight, int threads);

}  // namespace gonio::fitting
