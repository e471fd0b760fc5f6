// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/fitted_model.hpp"

#include <algorithm>

#include "brdf/observations.hpp"
#include "fitting/fit.hpp"

namespace gonio::fitting {

std::shared_ptr<const AnalyticBrdf> fitted_model(const std::shared_ptr<const Dataset>& dataset) {
  if (dataset->size() == 0) return nullptr;
  const auto observations = observe(dataset);
  const auto determined = [](const FitResult& result) {
    return result.status == Status::converged &&
           std::none_of(result.parameters.begin(), result.parameters.end(), [](const FittedParameter& p) {
             return p.kind == IntervalKind::unidentified || p.kind == IntervalKind::lower_bound;
           });
  };
  // Where the data show no lobe its parameters are undetermined, and the diffuse part alone is the model.
  for (const char* model : {"blinn-phong", "lambert"}) {
    FitOptions options;
    options.model = model;
    const FitResult result = fit(*observations, options);
    if (determined(result)) return std::make_shared<AnalyticBrdf>(result.model, result.channels, result.values);
    if (result.status != Status::converged) return nullptr;
    const bool lobe_seen = std::any_of(result.parameters.begin(), result.parameters.end(), [](const FittedParameter& p) {
      return p.name == "rho_s" && (p.kind == IntervalKind::interval || p.kind == IntervalKind::lower_bound);
    });
    if (lobe_seen) return nullptr;
  }
  return nullptr;
}

}  // namespace gonio::fitting
