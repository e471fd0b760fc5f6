// SPDX-License-Identifier: BSD-3-Clause
// How the variance of a reading grows with the value read, estimated from deviations.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gonio::fitting {

/// Variance of one sample as a function of its expected value f [1/sr] and its incidence (numerics D.6):
///   σ² = read + shot · f + gain² f² + (tilt · f tan θi)²
/// Trap: give it the fitted value, never the reading. Weights from the readings themselves favour low ones; at 10 % noise the albedos
/// come out 2 % low (numerics C13).
struct VarianceModel {
  double read = 0;  ///< variance that does not depend on f [1/sr²]
  double shot = 0;  ///< variance per f [1/sr]
  double gain = 0;  ///< standard deviation as a part of f [1]
  double tilt = 0;  ///< standard deviation of the incidence angle [rad]; f = L/(E cos θi) passes it on as tan θi

  /// `tan2_i` = tan² θi. Values below 0 count as 0.
  double operator()(double f, double tan2_i) const noexcept;
  /// No part of it is above zero: nothing is known of the scatter.
  bool empty() const noexcept { return !(read > 0 || shot > 0 || gain > 0 || tilt > 0); }
};

/// tan² θi from its cosine, limited where the cosine vanishes.
double tan_squared(double cosine) noexcept;

/// Squared deviations of readings from their expected values, added up in cells of nearly equal variance: four per octave of f, four
/// of the incidence. The parts of the model are linear in the sums, so nothing but a little efficiency is lost with the binning.
class DeviationCells {
 public:
  DeviationCells();
  /// `square`: the deviation squared [1/sr²]; `dof`: its degrees of freedom (1 for a residual; n - 1 for n readings and their mean,
  /// with the mean square).
  void add(double f, double tan2_i, double square, double dof = 1) noexcept;
  /// The sums of another set of cells beside these.
  void add(const DeviationCells& other) noexcept;
  void clear() noexcept;
  double dof() const noexcept { return dof_; }
  /// Mean of the squares over their variances by a model; 1 ± √(2/dof) if it is the right one.
  double mean_ratio(const VarianceModel& model) const noexcept;

 private:
  friend VarianceModel variance_model(const DeviationCells& cells);
  friend double information_criterion(const DeviationCells& cells, const VarianceModel& model);
  struct Cell {
    double dof = 0, square = 0;
    std::array<double, 4> regressor{};  ///< Σ dof · (1, f, f², f² tan²)
  };
  std::vector<Cell> cells_;
  double dof_ = 0;
};

/// The parts that maximise the likelihood of normal deviations, none below zero, by Fisher scoring: least squares of the squares with
/// weights dof/(2 σ⁴). Of all sets of read, shot and gain, and then of those with tilt beside or instead of gain, the one with the least
/// Bayesian information criterion (Schwarz 1978) counts, so a part that the data do not ask for is exactly 0; with too few degrees of
/// freedom for a choice the variance is a constant.
VarianceModel variance_model(const DeviationCells& cells);

/// Bayesian information criterion of a model: -2 ln of the likelihood of the deviations, up to a constant of theirs, and ln dof for
/// every part above zero.
double information_criterion(const DeviationCells& cells, const VarianceModel& model);

/// What robust estimates need of normal deviations: E[min(Z², k²)] (Huber 1964, proposal 2).
double truncated_second_moment(double k) noexcept;

}  // namespace gonio::fitting
