// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "brdf/error.hpp"
#include "fitting/fit_checks.hpp"
#include "fitting/fit_errors.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array<std::pair<Metric, const char*>, 5> metric_names{{{Metric::linear, "linear"},
                                                                      {Metric::linear_cos, "linear-cos"},
                                                                      {Metric::log, "log"},
                                                                      {Metric::log1p, "log1p"},
                                                                      {Metric::cbrt, "cbrt"}}};

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
  if (!faults.empty()) throw Error(ErrorKind::usage, "the fit of model '" + options.model + "' cannot be set up", faults);
}

SolveOptions solve_options(const FitOptions& options, const ModelKernel& kernel, std::size_t channels) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto& parameters = kernel.info->parameters;
  const auto wanted = [&](const Parameter& parameter) {
    const auto held = options.fixed.find(std::string(parameter.name));
    const auto bounds = options.bounds.find(std::string(parameter.name));
    const bool bounded = bounds != options.bounds.end();
    return Wanted{held == options.fixed.end() ? none : held->second, bounded ? bounds->second.low : none,
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
  out.threads = options.threads;
  return out;
}

FittedParameter fitted(const Parameter& parameter, const Estimate& estimate, std::optional<std::size_t> channel) {
  return {std::string(parameter.name),
          channel,
          estimate.value,
          estimate.sigma,
          estimate.low,
          estimate.high,
          estimate.kind,
          parameter.lower,
          parameter.upper};
}

/// Solutions in channel order: one for all, or one per channel.
void assemble(FitResult& result, const std::vector<Solution>& solutions, const Terms& terms) {
  const ModelKernel& kernel = terms.kernel;
  const auto& parameters = kernel.info->parameters;
  std::vector<Matrix> covariance;
  double cost = 0, dof = 0, budget = 0, signal_to_noise2 = 0;
  std::size_t count = 0;
  result.status = Status::converged;
  std::size_t channel = 0;
  for (const Solution& solution : solutions) {
    const auto own = solutions.size() > 1 ? std::optional(channel) : std::nullopt;
    if (!solution.converged && result.status == Status::converged) {
      result.status = Status::not_converged;
      result.reason = solution.reason;
    }
    for (const OtherSolution& other : solution.others)
      result.other_minima.push_back({own, other.theta, other.linear, other.cost, other.cost / solution.cost});
    for (std::size_t c = 0; c < solution.linear.size(); ++c, ++channel) {
      std::vector<double> values = solution.linear[c];
      values.insert(values.end(), solution.theta.begin(), solution.theta.end());
      result.values.push_back(std::move(values));
      for (std::size_t k = 0; k < kernel.linear; ++k)
        result.parameters.push_back(fitted(parameters[k], solution.linear_estimate[c][k], channel));
      covariance.push_back(solution.covariance_of(c));
    }
    cost += solution.cost;
    dof += solution.dof;
    budget = std::max(budget, solution.budget);
  }
  for (std::size_t k = 0; k < solutions.size(); ++k)
    for (std::size_t j = 0; j < kernel.nonlinear; ++j)
      result.parameters.push_back(fitted(parameters[kernel.linear + j], solutions[k].nonlinear_estimate[j],
                                         solutions.size() > 1 ? std::optional(k) : std::nullopt));
  for (const ChannelTerms& data : terms.channel) signal_to_noise2 += data.weighted_value2, count += data.count;
  if (terms.weighted && dof >= 1) result.errors.chi2_per_dof = cost / dof;
  result.checks = {energy_bound(result, kernel, covariance), at_bound(result), adequacy(cost, dof, signal_to_noise2, count, terms.weighted),
                   second_minimum(result, *kernel.info, budget, solutions.front().cost)};
}

}  // namespace

const char* name(Metric metric) noexcept {
  for (const auto& [value, text] : metric_names)
    if (value == metric) return text;
  return "linear";
}

std::optional<Metric> metric_named(std::string_view text) {
  for (const auto& [value, known] : metric_names)
    if (text == known) return value;
  return std::nullopt;
}

const char* name(Status status) noexcept {
  switch (status) {
    case Status::converged: return "converged";
    case Status::not_converged: return "not_converged";
    case Status::no_usable_data: return "no_usable_data";
    case Status::failed: return "failed";
  }
  return "failed";
}

const char* name(IntervalKind kind) noexcept {
  switch (kind) {
    case IntervalKind::interval: return "interval";
    case IntervalKind::lower_bound: return "lower_bound";
    case IntervalKind::upper_bound: return "upper_bound";
    case IntervalKind::unidentified: return "unidentified";
    case IntervalKind::fixed: return "fixed";
  }
  return "unidentified";
}

FitResult fit(const Observations& observations, const FitOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const ModelKernel kernel = model_kernel(options.model);
  require_usable(options, *kernel.info);
  FitResult result;
  result.model = options.model;
  result.metric = options.metric.value_or(Metric::linear);
  result.channels = observations.channels();

  Terms terms = make_terms(observations, kernel, result.metric, options.threads);
  result.n_observations = terms.n_observations;
  result.n_masked = terms.n_masked;
  const std::size_t channels = terms.channel.size();
  if (terms.n_observations == 0) {
    result.status = Status::no_usable_data;
    result.reason = "no sample can be used: all are masked, unknown or outside the domain of the metric";
  } else {
    std::vector<Solution> solutions;
    const auto correlated = observations.correlated();
    if (options.per_channel && channels > 1) {
      for (std::size_t c = 0; c < channels; ++c) {
        Terms one = only_channel(terms, c);
        solutions.push_back(solve(one, solve_options(options, kernel, 1), correlated));
      }
    } else {
      solutions.push_back(solve(terms, solve_options(options, kernel, channels), correlated));
    }
    const auto broken = std::find_if(solutions.begin(), solutions.end(), [](const Solution& s) { return s.linear.empty(); });
    if (broken != solutions.end()) {
      result.status = Status::failed;
      result.reason = broken->reason;
    } else {
      assemble(result, solutions, terms);
      const auto chi2_per_dof = result.errors.chi2_per_dof;
      result.errors = fit_errors(observations, kernel, result.values, options.threads);
      result.errors.chi2_per_dof = chi2_per_dof;
    }
  }
  result.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace gonio::fitting
