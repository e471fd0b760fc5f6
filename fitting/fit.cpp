// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "brdf/error.hpp"
#include "fitting/angle_bins.hpp"
#include "fitting/corrected.hpp"
#include "fitting/fit_checks.hpp"
#include "fitting/fit_errors.hpp"
#include "fitting/fit_setup.hpp"
#include "fitting/large_table.hpp"
#include "fitting/nuisance.hpp"
#include "fitting/shared_errors.hpp"
#include "fitting/solution.hpp"
#include "fitting/sufficient_statistics.hpp"
#include "fitting/weigh_and_convolve.hpp"

namespace gonio::fitting {
namespace {

/// Adds what was found for channels from `first` on.
void add_weighting(Weighting& to, Weighting from, std::size_t first) {
  for (Outlier& outlier : from.outliers) outlier.channel += first;
  const std::size_t counted = from.outliers.size();
  to.source = from.source;
  to.variance.insert(to.variance.end(), from.variance.begin(), from.variance.end());
  if (first == 0 || from.robust != Robust::none) to.robust = from.robust, to.reason = from.reason;
  to.n_outliers += from.n_outliers - counted;
  to.add(std::move(from.outliers));
}

void add_angles(std::vector<Outlier>& outliers, const Observations& observations) {
  std::vector<GonioAngles> angles;
  auto outlier = outliers.begin();
  for (std::size_t b = 0, first = 0; b < observations.block_count() && outlier != outliers.end(); ++b) {
    const std::size_t end = first + observations.block(b).size;
    if (outlier->sample < end) observations.angles(b, angles);
    for (; outlier != outliers.end() && outlier->sample < end; ++outlier) outlier->angles = angles[outlier->sample - first];
    first = end;
  }
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

/// An expression in a term's own names with those of the whole model.
std::string in_names_of(const ModelInfo& info, const ModelTerm& term, std::string_view expression) {
  std::string out, word;
  const auto finish = [&] {
    for (std::size_t k = 0; k < term.model->parameters.size(); ++k) {
      const bool linear = k < term.model->linear_count;
      if (word != term.model->parameters[k].name || (linear && k < term.first_basis)) continue;
      word =
          info.parameters[linear ? term.linear + k - term.first_basis : info.linear_count + term.nonlinear + k - term.model->linear_count]
              .name;
      break;
    }
    out += word;
    word.clear();
  };
  for (const char c : expression)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
      word += c;
    else
      finish(), out += c;
  finish();
  return out;
}

void add_determined(FitResult& result, const Solution& solution, const ModelInfo& info, std::size_t first_channel) {
  for (const Combination& found : solution.determined) {
    const ModelTerm& term = info.terms[found.term];
    const PeakName& peak = term.model->peak;
    Determined next;
    next.expression = in_names_of(info, term, peak.expression);
    next.unit = peak.unit;
    next.channel = first_channel + found.channel;
    next.value = peak.scale * found.estimate.value;
    if (found.estimate.sigma) next.sigma = peak.scale * *found.estimate.sigma;
    next.low = peak.scale * *found.estimate.low, next.high = peak.scale * *found.estimate.high;
    result.determined.push_back(next);
  }
}

/// Covariances of solutions, in the order of the result's parameters, as correlations.
std::vector<std::vector<double>> correlation(const std::vector<Solution>& solutions, const ModelKernel& kernel) {
  struct Place {
    std::size_t solution, row;
  };
  std::vector<Place> places;
  for (std::size_t s = 0; s < solutions.size(); ++s)
    for (std::size_t row = 0; row < solutions[s].linear.size() * kernel.linear; ++row) places.push_back({s, row});
  for (std::size_t s = 0; s < solutions.size(); ++s)
    for (std::size_t j = 0; j < kernel.nonlinear; ++j) places.push_back({s, solutions[s].linear.size() * kernel.linear + j});
  std::vector<std::vector<double>> out(places.size(), std::vector<double>(places.size(), 0.0));
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b) {
      const Matrix &of_a = solutions[places[a].solution].covariance, &of_b = solutions[places[b].solution].covariance;
      const double variances = of_a(places[a].row, places[a].row) * of_b(places[b].row, places[b].row);
      const double together = places[a].solution == places[b].solution ? of_a(places[a].row, places[b].row) : 0;
      out[a][b] = variances > 0 ? together / std::sqrt(variances) : std::numeric_limits<double>::quiet_NaN();
    }
  return out;
}

/// Status, values and minima of solutions in channel order: one for all, or one per channel.
void add_values(FitResult& result, const std::vector<Solution>& solutions) {
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
    }
  }
}

/// What the same solutions say beyond their values; the weighting stands in the result already.
void add_estimates(FitResult& result, const std::vector<Solution>& solutions, const ModelKernel& kernel, int threads) {
  const auto& parameters = kernel.info->parameters;
  std::vector<Matrix> covariance;
  double chi2 = 0, dof = 0, budget = 0, signal_to_noise2 = 0;
  const bool absolute = result.weighting.source == WeightSource::uncertainty || result.weighting.source == WeightSource::repeats ||
                        result.weighting.source == WeightSource::rows;
  std::size_t count = 0, channel = 0;
  for (const Solution& solution : solutions) {
    const std::size_t first = solutions.size() > 1 ? channel : 0;
    for (std::size_t c = 0; c < solution.linear.size(); ++c, ++channel) {
      for (std::size_t k = 0; k < kernel.linear; ++k)
        result.parameters.push_back(fitted(parameters[k], solution.linear_estimate[c][k], channel));
      covariance.push_back(solution.covariance_of(c));
    }
    add_determined(result, solution, *kernel.info, first);
    result.likelihood.log_likelihood += solution.log_likelihood;
    result.likelihood.free_parameters += static_cast<std::size_t>(solution.free_parameters);
    signal_to_noise2 += solution.signal_to_noise2;
    count += solution.count;
    chi2 += solution.chi2;
    dof += solution.chi2_dof;
    budget = std::max(budget, solution.budget);
  }
  for (std::size_t k = 0; k < solutions.size(); ++k)
    for (std::size_t j = 0; j < kernel.nonlinear; ++j)
      result.parameters.push_back(fitted(parameters[kernel.linear + j], solutions[k].nonlinear_estimate[j],
                                         solutions.size() > 1 ? std::optional(k) : std::nullopt));
  result.correlation = correlation(solutions, kernel);
  result.likelihood.n = count;
  if (absolute && dof >= 1) result.errors.chi2_per_dof = chi2 / dof;
  result.checks = {energy_bound(result, kernel, covariance, threads), at_bound(result),
                   adequacy(chi2, dof, signal_to_noise2, count, absolute),
                   second_minimum(result, *kernel.info, budget, solutions.front().cost), identifiability(result)};
}

/// The fit of terms that stand: everything but what only the observations know, the errors under every metric.
/// `observations`: null if the terms come from sums, which have no apertures. `means`: the samples compared with means over apertures, of
/// all channels or one for each.
FitResult fit_terms(Terms& terms, const Channels& channels, const Observations* observations, const FitOptions& options,
                    WeigherOptions weigher, const std::vector<CorrelatedComponent>& correlated, std::vector<MeanRows>& means) {
  const ModelKernel& kernel = terms.kernel;
  FitResult result;
  result.model = options.model;
  result.confidence = options.confidence;
  result.channels = channels;
  result.rows = {terms.rows_of, terms.sums ? terms.sums->rows() : terms.rows(), terms.approximation};
  result.n_observations = terms.n_observations;
  result.not_fitted = terms.not_fitted;
  if (terms.n_observations == 0) {
    result.status = Status::no_usable_data;
    result.reason = "no sample can be used: all are masked, unknown or outside the domain of the metric";
    return result;
  }
  const SharedErrors shared = shared_errors(correlated, holds_linear(options, *kernel.info));
  require_nuisance_possible(options, observations, terms.channel.size(), !shared.shape.empty());
  result.u_scale = shared.u_scale;
  std::vector<Solution> solutions;
  const auto solved = [&](Terms& these, std::size_t first) {
    Laps lap;
    SolveOptions how = solve_options(options, kernel, these.channel.size());
    weigher.free_parameters = free_parameters(how);
    std::vector<Change> changes;
    std::vector<Minimum> known;
    if (options.nuisance.any()) {
      NuisanceFit nuisance = fit_nuisance(these, *observations, how, options.nuisance, shared.shape, [&](const Observations& seen) {
        return weigh_and_convolve(these, how, weigher, &seen, options, result.aperture).weighting;
      });
      add_weighting(result.weighting, std::move(nuisance.weighting), first);
      result.nuisance = std::move(nuisance.parameters);
      how.nuisance = nuisance.free, how.nuisance_with_prior = nuisance.with_prior;
      changes = std::move(nuisance.changes);
    } else {
      if (!these.sums) {
        Weighed weighed = weigh_and_convolve(these, how, weigher, observations, options, result.aperture);
        add_weighting(result.weighting, std::move(weighed.weighting), first);
        known = std::move(weighed.minima);
      }
      changes = changes_by(these, shared.shape);
    }
    means.push_back(these.mean.renumbered(these.sample));
    result.stages.weights_s += lap();
    Solution solution = solve(these, how, changes, std::move(known));
    result.stages.scan_s += solution.scan_s;
    result.stages.intervals_s += solution.intervals_s;
    return solution;
  };
  if (options.per_channel && terms.channel.size() > 1) {
    for (std::size_t c = 0; c < terms.channel.size(); ++c) {
      Terms one = only_channel(terms, c);
      solutions.push_back(solved(one, c));
    }
  } else {
    solutions.push_back(solved(terms, 0));
  }
  const auto broken = std::find_if(solutions.begin(), solutions.end(), [](const Solution& s) { return s.linear.empty(); });
  if (broken == solutions.end()) {
    add_values(result, solutions);
    if (!options.only_values) add_estimates(result, solutions, kernel, options.threads);
  } else {
    result.status = Status::failed;
    result.reason = broken->reason;
  }
  return result;
}

}  // namespace

FitResult fit(const Observations& observations, const FitOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const ModelKernel kernel = model_kernel(options.model);
  require_usable(options, *kernel.info);
  const Metric metric = options.metric.value_or(Metric::linear);
  WeigherOptions weigher = weigher_options(options);
  // With weights by the variance of f the cosine of linear-cos cancels.
  const bool cancels = weigher.estimate_variance && metric == Metric::linear_cos;
  const Metric minimised = cancels ? Metric::linear : metric;
  std::optional<LargeTable> large;
  Weighting judged;
  StageTimes stages;
  Laps lap;
  const bool by_measure = options.weights == Weights::solid_angle, as_rows = by_measure || options.nuisance.any();
  if (!options.per_channel && !as_rows) large = large_table(observations, kernel, minimised, options.threads);
  stages.collapse_s = lap();
  if (large) {
    const SolveOptions how = solve_options(options, kernel, observations.channels().size());
    weigher.free_parameters = free_parameters(how);
    if (!weigh_by_part(*large, weigher, how, judged)) large.reset();
  }
  stages.weights_s = lap();
  std::optional<Terms> bins;
  if (!large && !as_rows) bins = binned_terms(observations, kernel, minimised, options.ignore_apertures, weigher.robust, options.threads);
  Terms terms = large ? std::move(large->terms)
                : bins
                    ? std::move(*bins)
                    : make_terms(observations, kernel, minimised, options.threads, weigher.robust, options.weights, options.most_samples);
  stages.collapse_s += lap();
  // A part of the samples breaks repeats apart.
  const bool repeats_count = weigher.estimate_variance && !terms.weighted && !terms.collapsed && terms.approximation.empty() && !terms.sums;
  const auto repeats = repeats_count ? repeated_readings(observations) : std::vector<RepeatedReadings>{};
  weigher.repeats = repeats;
  stages.weights_s += lap();
  std::vector<MeanRows> means;
  FitResult result = fit_terms(terms, observations.channels(), &observations, options, weigher, observations.correlated(), means);
  result.stages.collapse_s = stages.collapse_s;
  result.stages.weights_s += stages.weights_s;
  if (large) result.weighting = std::move(judged);
  if (by_measure) result.weighting.source = WeightSource::solid_angle;
  result.metric = metric;
  if (!result.values.empty() && !options.only_values) {
    lap();
    const auto aligned = result.nuisance.empty() ? nullptr : corrected(observations, result.nuisance);
    add_residuals(result, aligned ? *aligned : observations, kernel, means, options.threads);
    result.stages.errors_s = lap();
  }
  add_angles(result.weighting.outliers, observations);
  result.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FitResult fit(const SufficientStatistics& statistics, const FitOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const ModelKernel kernel = model_kernel(options.model);
  require_usable(options, *kernel.info);
  if (options.metric && *options.metric != statistics.metric)
    throw Error(ErrorKind::usage, {"metric", name(*options.metric), std::string(name(statistics.metric)) + ", whose sums these are"});
  WeigherOptions weigher = weigher_options(options);
  require_estimable(statistics.weighted, statistics.rows, options);
  if (statistics.rows == SufficientStatistics::Rows::directions) weigher.estimate_variance = false, weigher.robust = Robust::none;
  Terms terms = make_terms(statistics, kernel);
  std::vector<MeanRows> none;
  FitResult result = fit_terms(terms, statistics.channels, nullptr, options, weigher, statistics.correlated, none);
  result.metric = statistics.metric;
  if (statistics.n_outliers > 0) {
    result.weighting.n_outliers += statistics.n_outliers;
    result.weighting.robust = weigher.robust;
    result.weighting.reason = "the means of table rows were made without values far from the others of their row";
  }
  if (!result.values.empty() && !options.only_values) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const auto chi2_per_dof = result.errors.chi2_per_dof;
    result.errors = {unknown, unknown, unknown, unknown, unknown, chi2_per_dof};
    const std::array errors{&result.errors.linear, &result.errors.linear_cos, &result.errors.log, &result.errors.log1p,
                            &result.errors.cbrt};
    if (!statistics.weighted)
      *errors[static_cast<std::size_t>(statistics.metric)] = rms_of_rows(make_terms(statistics, kernel), result.values);
  }
  result.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace gonio::fitting
