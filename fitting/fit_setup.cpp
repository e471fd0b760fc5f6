// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit_setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "brdf/error.hpp"

namespace gonio::fitting {

void require_usable(const FitOptions& options, const ModelInfo& info) {
  std::vector<Fault> faults;
  std::string known;
  for (const Parameter& parameter : info.parameters) known += (known.empty() ? "" : ", ") + std::string(parameter.name);
  const auto find = [&](const std::string& what, const std::string& name) {
    const auto found = std::find_if(info.parameters.begin(), info.parameters.end(), [&](const Parameter& p) { return p.name == name; });
    if (found != info.parameters.end()) return &*found;
    faults.push_back({what, "'" + name + "'", "one of " + known});
    return static_cast<const Parameter*>(nullptr);
  };
  for (const auto& [name, value] : options.fixed)
    if (const Parameter* parameter = find("fixed parameter", name); parameter && !(value >= parameter->lower && value <= parameter->upper))
      faults.push_back({"fixed parameter " + name, std::to_string(value), "a number within the bounds of the model"});
  for (const auto& [name, bounds] : options.bounds) {
    const Parameter* parameter = find("bounds", name);
    if (!parameter) continue;
    const std::string found = std::to_string(bounds.low) + " to " + std::to_string(bounds.high);
    if (options.fixed.count(name)) faults.push_back({"bounds of " + name, found, "none, or the parameter not fixed"});
    if (!(bounds.low < bounds.high && bounds.low >= parameter->lower && bounds.high <= parameter->upper))
      faults.push_back({"bounds of " + name, found, "a range within the bounds of the model"});
  }
  if (!(options.confidence > 0 && options.confidence < 1))
    faults.push_back({"confidence", std::to_string(options.confidence), "a number between 0 and 1"});
  if (options.weights == Weights::solid_angle && options.robust.value_or(Robust::none) != Robust::none)
    faults.push_back({"robust", name(*options.robust), "none: solid angles say nothing of how wrong a reading may be"});
  if (!faults.empty()) throw Error(ErrorKind::usage, "the fit of model '" + options.model + "' cannot be set up", faults);
}

SolveOptions solve_options(const FitOptions& options, const ModelKernel& kernel, std::size_t channels) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto& parameters = kernel.info->parameters;
  const auto wanted = [&](const Parameter& parameter) {
    const auto held = options.fixed.find(std::string(parameter.name));
    const auto bounds = options.bounds.find(std::string(parameter.name));
    const bool bounded = bounds != options.bounds.end();
    const double at_rest = parameter.held && !bounded ? parameter.example : none;
    return Wanted{held == options.fixed.end() ? at_rest : held->second, bounded ? bounds->second.low : none,
                  bounded ? bounds->second.high : none};
  };
  SolveOptions out;
  LinearLimits limits;
  std::vector<bool> free;
  bool bounded = false;
  for (std::size_t k = 0; k < kernel.linear; ++k) {
    const Wanted own = wanted(parameters[k]);
    limits.held.push_back(own.held);
    limits.lower.push_back(std::isnan(own.lower) ? 0 : own.lower);
    limits.upper.push_back(std::isnan(own.upper) ? infinity : own.upper);
    bounded = bounded || !std::isnan(own.lower);
    free.push_back(std::isnan(own.held) && std::isnan(own.lower));
  }
  if (!bounded) limits.lower.clear(), limits.upper.clear();
  out.limits.assign(channels, limits);
  for (std::size_t j = 0; j < kernel.nonlinear; ++j) out.nonlinear.push_back(wanted(parameters[kernel.linear + j]));
  for (const ModelTerm& term : kernel.info->terms) {
    const std::size_t lobe = term.linear + (term.first_basis == 0 ? 1 : 0), end = term.linear + term.model->linear_count - term.first_basis;
    out.alike.push_back(std::all_of(free.begin() + static_cast<std::ptrdiff_t>(std::min(lobe, end)),
                                    free.begin() + static_cast<std::ptrdiff_t>(end), [](bool is_free) { return is_free; }));
  }
  out.confidence = options.confidence;
  out.only_values = options.only_values;
  out.threads = options.threads;
  return out;
}

bool holds_linear(const FitOptions& options, const ModelInfo& info) {
  const auto held = [&](const Parameter& parameter) {
    const auto found = options.fixed.find(std::string(parameter.name));
    return found != options.fixed.end() && found->second != 0;
  };
  return std::any_of(info.parameters.begin(), info.parameters.begin() + static_cast<std::ptrdiff_t>(info.linear_count), held);
}

WeigherOptions weigher_options(const FitOptions& options) {
  const bool by_default = options.weights == Weights::automatic && !options.metric;
  WeigherOptions out;
  out.threads = options.threads;
  out.estimate_variance = options.weights == Weights::variance || by_default;
  out.robust = options.robust.value_or(by_default ? Robust::automatic : Robust::none);
  return out;
}

std::size_t free_parameters(const SolveOptions& options) {
  std::size_t out = 0;
  for (const LinearLimits& channel : options.limits)
    for (const double held : channel.held) out += std::isnan(held);
  for (const Wanted& wanted : options.nonlinear) out += std::isnan(wanted.held);
  return out;
}

}  // namespace gonio::fitting
