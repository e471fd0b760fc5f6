// SPDX-License-Identifier: BSD-3-Clause
// Sets the weights of the terms from the scatter of the data, and leaves wrong readings out.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fitting/repeats.hpp"
#include "fitting/terms.hpp"
#include "fitting/weighting.hpp"

namespace gonio::fitting {

struct WeigherOptions {
  bool estimate_variance = false;  ///< replace weights of 1 by a variance model
  Robust robust = Robust::none;
  std::size_t free_parameters = 0;            ///< of all channels of the terms together
  std::span<const RepeatedReadings> repeats;  ///< of the observations the terms were made from
  int threads = 1;
};

/// Fitted values [1/sr] per channel and row under the weights that stand in the terms now; none if there is no solution.
/// `global`: look for every minimum again; otherwise the neighbourhood of the last solution will do.
using Fitter = std::function<std::optional<std::vector<std::vector<double>>>(bool global)>;

/// Sets the weights of the terms; the caller solves once more with them.
///   variance  least squares with weights 1; then three times a variance model of the residuals (or, once, of the repeats, if they hold
///             a fifth of the samples) at the fitted values, and a fit with its weights. The models of the channels are one if the
///             Bayesian information criterion says so. Collapsed rows take their own scatter, drawn towards the model of all rows.
///   robust    automatic: residuals that look clean (none beyond `outlier_limit`, median not far below that of the normal
///             distribution) change nothing at all. Otherwise Cauchy weights with a scale from truncated squares (Huber's proposal 2)
///             until the list of outliers stands, with a global search at first, and then least squares without the outliers. Outliers in
///             runs are a model that does not fit: then nothing is left out.
///             huber, cauchy: that loss from the same start.
/// Collapsed rows have met their wrong readings before (robust_mean).
Weighting weigh(Terms& terms, const WeigherOptions& options, const Fitter& fitter);

}  // namespace gonio::fitting
