// SPDX-License-Identifier: BSD-3-Clause
// Root mean square residuals of a fitted model under every metric.
#pragma once

#include "fitting/fit.hpp"
#include "fitting/model_kernel.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// Unweighted, over all channels together and every sample for which the metric is defined. Beyond 2^18 samples estimated from 2^15 of
/// them, an even stride through every block, which keeps the cost of a whole table at a few milliseconds and the error of an rms below a
/// percent. `chi2_per_dof` is left alone.
FitErrors fit_errors(const Observations& observations, const ModelKernel& kernel, const std::vector<std::vector<double>>& values,
                     int threads);

/// Root mean square of the residuals of rows whose weights are 1 (cos² θi under linear-cos), from their sums: exact for collapsed rows.
double rms_of_rows(const Terms& terms, const std::vector<std::vector<double>>& values);

}  // namespace gonio::fitting
