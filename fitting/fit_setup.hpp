// SPDX-License-Identifier: BSD-3-Clause
// What the options of a fit ask of the solver and of the weights.
#pragma once

#include <cstddef>

#include "fitting/fit.hpp"
#include "fitting/solution.hpp"
#include "fitting/weigher.hpp"

namespace gonio::fitting {

/// Error(usage) with every fixed parameter and bound that the model does not have or allow, and a confidence that is none.
void require_usable(const FitOptions& options, const ModelInfo& info);

SolveOptions solve_options(const FitOptions& options, const ModelKernel& kernel, std::size_t channels);
/// Whether the caller holds a linear parameter at a value other than 0.
bool holds_linear(const FitOptions& options, const ModelInfo& info);
/// What is asked of the weights, with the defaults of FitOptions filled in.
WeigherOptions weigher_options(const FitOptions& options);
/// Parameters of the model that are fitted, of all channels.
std::size_t free_parameters(const SolveOptions& options);

}  // namespace gonio::fitting
