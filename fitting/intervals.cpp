// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals, widened by the errors that samples share.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/covariance.hpp"
#include "fitting/determined.hpp"
#include "fitting/distributions.hpp"
#include "fitting/line_intervals.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-13;    // of the terms themselves: a perfect fit still has this much uncertainty
constexpr double at_rounding = 1e6;   // of that squared: residuals so small are rounding errors, whose profile has no shape
constexpr double significant = 0.01;  // probability of a χ² that widens intervals

/// The kind of an estimate from ends that may not exist, widened by `extra` (the part of sigma that samples share, times q).
Estimate classify(double value, double low, double high, double extra, double lower_bound, double variance) {
  Estimate out;
  out.value = value;
  const bool has_low = low > lower_bound && std::isfinite(low), has_high = std::isfinite(high);
  if (has_low) out.low = std::max(lower_bound, value - std::hypot(value - low, extra));
  if (has_high) out.high = value + std::hypot(high - value, extra);
  out.kind = has_low && has_high ? IntervalKind::interval
             : has_low           ? IntervalKind::lower_bound
             : has_high          ? IntervalKind::upper_bound
                                 : IntervalKind::unidentified;
  if (out.kind == IntervalKind::interval && variance > 0) out.sigma = std::sqrt(variance);
  return out;
}

Estimate fixed_at(double value) {
  Estimate out;
  out.value = value;
  out.kind = IntervalKind::fixed;
  return out;
}

/// Ends from the covariance alone, on the axes of the search; none where there is no covariance.
std::vector<Reach> linearised_reach(const Solution& solution, const ParameterPlaces& places, const SearchSpace& space,
                                    const Matrix& covariance, double quantile) {
  std::vector<Reach> out(places.size());
  const auto set = [&](std::size_t place, double value, double slope) {
    const double half = quantile * std::sqrt(covariance(place, place)) / slope;
    if (std::isfinite(half)) out[place] = {value - half, value + half};
  };
  for (std::size_t c = 0; c < places.channels; ++c)
    for (std::size_t k = 0; k < places.linear; ++k) set(places.of_linear(c, k), solution.linear[c][k], 1);
  for (const SearchAxis& axis : space.axes()) {
    const double value = solution.theta[axis.parameter];
    Reach& reach = out[places.of_nonlinear(axis.parameter)];
    set(places.of_nonlinear(axis.parameter), axis.coordinate(value), axis.slope(value));
    // Beyond the search there is no end.
    if (reach.low < axis.low) reach.low = -infinity;
    if (reach.high > axis.high) reach.high = infinity;
  }
  return out;
}

}  // namespace

void estimate(Solution& solution, const Profile& profile, const SearchSpace& space, const Found& found, const SolveOptions& options,
              const std::vector<Change>& changes) {
  const Terms& terms = profile.terms();
  const ParameterPlaces places{terms.channel.size(), terms.kernel.linear, terms.kernel.nonlinear};
  double count = 0, size_of_terms = 0, log_weights = 0;
  solution.free_parameters = static_cast<double>(space.dimension() + options.nuisance);
  for (std::size_t c = 0; c < places.channels; ++c) {
    const ChannelTerms& data = terms.channel[c];
    count += static_cast<double>(data.count);
    for (std::size_t row = 0; row < terms.rows(); ++row) {
      size_of_terms += data.weight[row] * data.target[row] * data.target[row];
      const double samples = terms.collapsed            ? static_cast<double>(data.row_count[row])
                             : terms.represents.empty() ? 1
                                                        : terms.represents[row];
      if (data.weight[row] > 0 && samples > 0) log_weights += samples * std::log(data.weight[row] / samples);
    }
    for (const double held : profile.limits()[c].held) solution.free_parameters += std::isnan(held);
  }
  solution.dof = count - solution.free_parameters;
  const bool scale_known = terms.weighted || terms.pure_error || solution.dof >= 1;
  const double floor = rounding * rounding * size_of_terms;
  double constants = 0, informative = 0;
  for (const ChannelTerms& data : terms.channel) {
    constants += data.within;
    solution.signal_to_noise2 += data.weighted_value2;
    solution.count += data.count;
    const auto rows = std::count_if(data.weight.begin(), data.weight.end(), [](double w) { return w > 0; });
    informative += terms.collapsed ? static_cast<double>(rows) : static_cast<double>(data.count);
  }
  solution.chi2 = terms.pure_error ? solution.cost - constants : solution.cost;
  solution.chi2_dof = terms.pure_error ? informative - solution.free_parameters : solution.dof;
  const bool misses = terms.pure_error && solution.chi2_dof >= 1 && chi2_upper_tail(solution.chi2, solution.chi2_dof) < significant;
  const bool absolute = terms.weighted || terms.pure_error;
  const double scale = misses     ? solution.chi2 / solution.chi2_dof
                       : absolute ? 1
                                  : std::max(solution.cost, floor) / std::max(1.0, solution.dof);
  const double q = absolute ? normal_upper_quantile((1 - options.confidence) / 2)
                            : student_two_sided_quantile(options.confidence, std::max(1.0, solution.dof));
  solution.budget = std::max(q * q * scale, floor);
  // Of normal residuals; without weights their one variance is a parameter too, at its most likely value cost/n.
  const double two_pi = 2 * std::numbers::pi, variance = std::max(solution.cost, floor) / std::max(1.0, count);
  solution.log_likelihood = absolute ? -0.5 * (solution.cost + count * std::log(two_pi) - log_weights)
                                     : -0.5 * (count * (1 + std::log(two_pi * variance)) - log_weights);
  solution.free_parameters += static_cast<double>(options.nuisance_with_prior) + (absolute ? 0 : 1);

  const auto linearised = [&](std::span<const Change> by) {
    return linearise(terms, space, profile.limits(), solution.linear, solution.theta, by, options.threads);
  };
  const Linearisation about = linearised({});
  const Matrix own = covariance(about, places, space, scale);
  solution.covariance = own;
  const auto moves = changes.empty() ? std::vector<std::vector<double>>{} : responses(linearised(changes), places, space);
  std::vector<double> shared(places.size(), 0.0);
  for (const std::vector<double>& move : moves)
    for (std::size_t a = 0; a < places.size(); ++a) {
      shared[a] += move[a] * move[a];
      for (std::size_t b = 0; b < places.size(); ++b) solution.covariance(a, b) += move[a] * move[b];
    }

  // The profile may lie a rounding error below or above the polished cost: the lower of the two is the floor.
  double least = solution.cost;
  for (const Minimum& minimum : found.minima) least = std::min(least, minimum.point.cost);
  std::vector<std::size_t> free_axes, free_linear;
  for (const SearchAxis& axis : space.axes()) free_axes.push_back(places.of_nonlinear(axis.parameter));
  for (std::size_t c = 0; c < places.channels; ++c)
    for (std::size_t k = 0; k < places.linear; ++k)
      if (std::isnan(profile.limits()[c].held[k])) free_linear.push_back(places.of_linear(c, k));
  const bool exact = solution.cost <= at_rounding * floor;
  const auto walk = [&](const std::vector<std::size_t>& asked) {
    if (exact) return linearised_reach(solution, places, space, own, q);
    std::vector<Minimum> minima{{space.coordinates(solution.theta), profile.at(solution.theta, options.threads)}};
    minima.insert(minima.end(), found.minima.begin(), found.minima.end());
    return joint_reach(profile, space, minima, places, asked, own, least, solution.budget, q, options.threads);
  };
  std::vector<Reach> reach(places.size());
  std::optional<LineIntervals> line;
  if (scale_known && space.dimension() < 2) {
    if (!found.scan.empty())
      reach[free_axes.front()] = reach_on_scan(profile, space, found, least, solution.budget, options.threads);
    else if (!free_axes.empty())
      reach = walk(free_axes);
    line.emplace(profile, space, free_axes.empty() ? Reach{} : reach[free_axes.front()], solution.theta, least, solution.budget,
                 options.threads);
    for (const std::size_t place : free_linear) reach[place] = line->linear(place / places.linear, place % places.linear);
  } else if (scale_known) {
    free_linear.insert(free_linear.end(), free_axes.begin(), free_axes.end());
    reach = walk(free_linear);
  }

  solution.nonlinear_estimate.assign(places.nonlinear, {});
  for (std::size_t j = 0; j < places.nonlinear; ++j) solution.nonlinear_estimate[j] = fixed_at(solution.theta[j]);
  for (const SearchAxis& axis : space.axes()) {
    const std::size_t place = places.of_nonlinear(axis.parameter);
    const double value = solution.theta[axis.parameter];
    // Shared components act on the parameter itself; on its axis, where the interval is formed, divided by the slope.
    const double extra = q * std::sqrt(shared[place]) / axis.slope(value);
    Estimate estimate =
        classify(axis.coordinate(value), reach[place].low, reach[place].high, extra, -infinity, solution.covariance(place, place));
    estimate.value = value;
    if (estimate.low) estimate.low = axis.value(*estimate.low);
    if (estimate.high) estimate.high = axis.value(*estimate.high);
    solution.nonlinear_estimate[axis.parameter] = estimate;
  }
  solution.linear_estimate.assign(places.channels, {});
  for (std::size_t c = 0; c < places.channels; ++c)
    for (std::size_t k = 0; k < places.linear; ++k) {
      if (const double held = profile.limits()[c].held[k]; !std::isnan(held)) {
        solution.linear_estimate[c].push_back(fixed_at(held));
        continue;
      }
      const std::size_t place = places.of_linear(c, k);
      const std::vector<double>&lower = profile.limits()[c].lower, &upper = profile.limits()[c].upper;
      const double least_value = lower.empty() ? 0 : lower[k];
      const double most_value = std::min(terms.kernel.info->parameters[k].upper, upper.empty() ? infinity : upper[k]);
      const double high = reach[place].high >= most_value ? infinity : reach[place].high;
      solution.linear_estimate[c].push_back(classify(solution.linear[c][k], reach[place].low, high, q * std::sqrt(shared[place]),
                                                     least_value, solution.covariance(place, place)));
    }
  if (scale_known) add_determined(solution, profile, space, line ? &*line : nullptr, {about, places, scale, q, moves});
}

}  // namespace gonio::fitting
