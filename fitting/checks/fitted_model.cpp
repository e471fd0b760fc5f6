// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/fitted_model.hpp"

#include <algorithm>

#include "brdf/observations.hpp"
#include "fitting/fit.hpp"

namespace gonio::fitting {
namespace {

constexpr double flat_enough = 1.1;  // χ² of the diffuse part over that of the best lobe

double misfit(const FitResult& result) { return result.errors.chi2_per_dof.value_or(result.errors.linear * result.errors.linear); }

}  // namespace

std::shared_ptr<const AnalyticBrdf> fitted_model(const std::shared_ptr<const Dataset>& dataset) {
  if (dataset->size() == 0) return nullptr;
  const auto observations = observe(dataset);
  const auto determined = [](const FitResult& result) {
    return result.status == Status::converged &&
           std::none_of(result.parameters.begin(), result.parameters.end(), [](const FittedParameter& p) {
             return p.kind == IntervalKind::unidentified || p.kind == IntervalKind::lower_bound;
           });
  };
  FitOptions options;
  options.robust = Robust::none;  // a sharp lobe on few samples is no contamination
  const FitResult lobe = fit(*observations, options);
  if (determined(lobe)) return std::make_shared<AnalyticBrdf>(lobe.model, lobe.channels, lobe.values);
  // Where the data show no lobe its parameters are undetermined, and the diffuse part alone is the model.
  options.model = "lambert";
  const FitResult diffuse = fit(*observations, options);
  if (!determined(diffuse) || misfit(diffuse) > flat_enough * misfit(lobe)) return nullptr;
  return std::make_shared<AnalyticBrdf>(diffuse.model, diffuse.channels, diffuse.values);
}

}  // namespace gonio::fitting
