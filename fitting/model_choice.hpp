// SPDX-License-Identifier: BSD-3-Clause
// Which of several models describes the data, how well, and whether any of them does.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/incidence_folds.hpp"
#include "fitting/prediction.hpp"

namespace gonio::fitting {

struct ChoiceOptions {
  std::vector<std::string> models;                ///< of the list, or sums
  FitOptions fit;                                 ///< of every model; its `model` and `threads` do not count
  std::size_t max_folds = 10;                     ///< of the cross-validation
  double margin = 0.1;                            ///< a model is adequate if it predicts to within this, relative, beyond the noise
  int jobs = 2;                                   ///< fits at a time; the result does not depend on it
  std::function<void(std::size_t total)> fitted;  ///< called after every fit of `total`, from several threads
  const std::atomic<bool>* stop = nullptr;
};

/// One model. Cross-validated figures are of samples that the values had not seen.
struct Candidate {
  std::string model;
  bool single_lobe = true;  ///< no sum of models
  bool ranked = false;
  std::string reason;  ///< why it is not ranked, or what its rank does not tell; empty: nothing to say
  FitResult fit;       ///< to all samples
  std::size_t free_parameters = 0;
  /// Akaike's criterion for small samples (Hurvich and Tsai 1989) and the Bayesian one (Schwarz 1978), from the likelihood of the metric
  /// that was minimised; the smaller the better, differences alone mean something. Where the data carry u and even the best model has
  /// chi² per degree of freedom c > 1, chi² is divided by c for all of them. They take every sample for independent, which the misfit of
  /// a model is not: where they and the cross-validation disagree, believe the latter.
  std::optional<double> aicc, bic;
  std::array<std::optional<double>, every_metric.size()> cross_validated{};  ///< root mean square errors
  std::array<std::optional<std::size_t>, every_metric.size()> rank{};        ///< by them, from 1; ties share a rank
  /// Geometric mean over `ranking_metrics` of the cross-validated error over that of the best model: 1 is best in everything.
  std::optional<double> score;
  /// Cross-validated error beyond the noise over the root mean square of f: the larger of that under linear-cos and 3 times that under
  /// cbrt (a small relative change of ∛f is a third of that of f).
  std::optional<double> relative_error;
  bool adequate = false;  ///< relative_error <= margin
  std::string hint;       ///< e.g. that its profile has two minima, which often means a second lobe
};

inline constexpr std::array ranking_metrics{Metric::linear_cos, Metric::log1p, Metric::cbrt};

struct ModelChoice {
  std::vector<Candidate> candidates;  ///< ranked ones first, the best at the front
  std::optional<std::string> best;    ///< the first ranked
  /// The model with the fewest free parameters whose cross-validated errors are not larger than those of the best by more than one
  /// standard error of their difference over the folds (the rule of Breiman et al., CART, 1984, applied to paired differences).
  std::optional<std::string> simplest;
  bool any_adequate = false, single_lobe_adequate = false;
  std::string verdict;  ///< one sentence
  Folds folds;          ///< without `of_sample`
  NoiseLevel noise;
  double margin = 0;
  std::size_t n_samples = 0;  ///< samples used for cross-validation; of large tables an even part
  double choice_s = 0;
};

/// Fits every model to all samples and again without each fold of incidences (incidence_folds.hpp), holds the second fits against what
/// they have not seen, under all metrics, and ranks. A model that cannot be set up or does not converge is listed with its reason.
/// Above 2^14 samples cross-validation uses an even, pseudo-random part of about that size; the fits to all samples use all.
/// Error(usage) for an unknown model, Error(interrupted) when stopped.
ModelChoice choose_model(std::shared_ptr<const Observations> observations, const ChoiceOptions& options);

}  // namespace gonio::fitting
