// SPDX-License-Identifier: BSD-3-Clause
// Residuals of a fitted model: their root mean square under every metric, and where they are large.
#pragma once

#include <vector>

#include "fitting/fit.hpp"
#include "fitting/model_kernel.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// Fills `errors` (all but chi2_per_dof) and `residuals` of a result whose values and weighting stand, from the samples of
/// FittedSamples; of the part of a large table the error of an rms is below a percent.
///   errors     unweighted, over all channels together and every sample for which the metric is defined
///   residuals  without the outliers that the result lists, and where it has more than it lists without what is far from its cell
void add_residuals(FitResult& result, const Observations& observations, const ModelKernel& kernel, const std::vector<MeanRows>& means,
                   int threads);

/// Root mean square of the residuals of rows whose weights are 1 (cos² θi under linear-cos), from their sums: exact for collapsed rows.
double rms_of_rows(const Terms& terms, const std::vector<std::vector<double>>& values);

}  // namespace gonio::fitting
