// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals and correlated components.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/covariance.hpp"
#include "fitting/distributions.hpp"
#include "fitting/joint_intervals.hpp"
#include "fitting/row_triangles.hpp"
#include "fitting/solution.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t interval_nodes = 33;  // across the interval of the nonlinear parameter, a parabola through the best three
constexpr double rounding = 1e-13;          // of the terms themselves: a perfect fit still has this much uncertainty
constexpr double significant = 0.01;        // probability of a χ² that widens intervals
constexpr std::size_t many_rows = 1000;     // worth several threads

/// The profile along the one axis of the search.
struct Line {
  const Profile& profile;
  const SearchSpace& space;
  int threads;  ///< of one evaluation

  ProfilePoint at(double z) const { return profile.at(space.theta(std::span(&z, 1)), threads); }
};

/// The end of the interval between a point inside and a point outside the budget: root of √(P - P_min) = √budget, which is nearly linear
/// on the axis, by the Illinois form of the secant rule.
double end_of_interval(const Line& line, double inside, double outside, double least, double budget, double outside_cost) {
  const auto excess = [&](double cost) { return std::sqrt(std::max(0.0, cost - least)) - std::sqrt(budget); };
  double a = inside, fa = excess(line.at(inside).cost), b = outside, fb = excess(outside_cost);
  if (!(fa < 0)) return inside;
  for (int step = 0; step < 60; ++step) {
    double x = std::isfinite(fb) ? b - fb * (b - a) / (fb - fa) : 0.5 * (a + b);
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    const double fx = excess(line.at(x).cost);
    if (std::abs(fx) <= 1e-6 * std::sqrt(budget) || std::abs(b - a) <= 1e-12) return x;
    if ((fx > 0) == (fb > 0)) {
      fa *= 0.5;
    } else {
      a = b, fa = fb;
    }
    b = x, fb = fx;
  }
  return b;
}

/// Ends on the axis, and the finite stretch that was looked at.
struct LineRange {
  Reach reach;
  double from = 0, to = 0;
};

LineRange range_on(const Line& line, const Found& found, double least, double budget) {
  struct Node {
    double z, cost;
  };
  std::vector<Node> nodes;
  for (const ProfilePoint& point : found.scan) nodes.push_back({line.space.coordinates(point.theta).front(), point.cost});
  for (const Minimum& minimum : found.minima) nodes.push_back({minimum.z.front(), minimum.point.cost});
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.z < b.z; });
  const auto inside = [&](const Node& node) { return node.cost <= least + budget; };
  const auto first = std::find_if(nodes.begin(), nodes.end(), inside);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), inside);
  LineRange range;
  range.from = nodes.front().z, range.to = nodes.back().z;
  if (first == nodes.end()) return range;
  if (first != nodes.begin()) {
    const auto before = first - 1;
    range.reach.low = range.from = end_of_interval(line, first->z, before->z, least, budget, before->cost);
  }
  if (last != nodes.rbegin()) {
    const auto after = last - 1;
    range.reach.high = range.to = end_of_interval(line, last->z, after->z, least, budget, after->cost);
  }
  return range;
}

/// The largest of values on equal steps, refined by the parabola through it and its neighbours.
double peak(const std::vector<double>& values) {
  const auto best = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  if (best == 0 || best + 1 == values.size()) return values[best];
  const double a = values[best - 1], b = values[best], c = values[best + 1], curvature = a - 2 * b + c;
  if (!std::isfinite(a) || !std::isfinite(c) || !(curvature < 0)) return b;
  return b - (a - c) * (a - c) / (8 * curvature);
}

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

/// The reach of every parameter with one nonlinear parameter at most: along its axis, and of the linear ones the largest and smallest
/// values over all points of the axis within the budget.
std::vector<Reach> reach_on_line(const Solution& solution, const Profile& profile, const SearchSpace& space, const Found& found,
                                 const ParameterPlaces& places, double least, int threads) {
  const Line line{profile, space, threads};
  const bool split = profile.terms().rows() > many_rows && profile.terms().rows() <= rows_per_piece;
  std::vector<Reach> out(places.size());
  std::vector<ProfilePoint> nodes;
  if (space.dimension() == 1) {
    const LineRange range = range_on(line, found, least, solution.budget);
    out[places.of_nonlinear(space.axes().front().parameter)] = range.reach;
    nodes.resize(interval_nodes);
    const Line alone{profile, space, split ? 1 : threads};
    for_each_index(interval_nodes, split ? threads : 1, [&](std::size_t k) {
      nodes[k] = alone.at(range.from + (range.to - range.from) * static_cast<double>(k) / (interval_nodes - 1));
    });
  }
  const ProfilePoint centre = profile.at(solution.theta, threads);
  for (std::size_t c = 0; c < places.channels; ++c)
    for (std::size_t k = 0; k < places.linear; ++k) {
      if (!std::isnan(profile.limits()[c].held[k])) continue;
      const auto range_at = [&](const ProfilePoint& point) {
        const ChannelPart& part = point.channel[c];
        return range_of(part.system, k, least + solution.budget - (point.cost - part.cost) - part.rest);
      };
      Range whole = range_at(centre);
      std::vector<double> falling, rising;
      for (const ProfilePoint& node : nodes) {
        const Range at_node = range_at(node);
        falling.push_back(at_node.empty() ? -infinity : -at_node.low);
        rising.push_back(at_node.high);
      }
      if (!nodes.empty()) whole = {std::min(whole.low, -peak(falling)), std::max(whole.high, peak(rising))};
      out[places.of_linear(c, k)] = {whole.low, whole.high};
    }
  return out;
}

}  // namespace

void estimate(Solution& solution, const Profile& profile, const SearchSpace& space, const Found& found, const SolveOptions& options,
              const std::vector<CorrelatedComponent>& correlated) {
  const Terms& terms = profile.terms();
  const ParameterPlaces places{terms.channel.size(), terms.kernel.linear, terms.kernel.nonlinear};
  double count = 0, size_of_terms = 0, free_parameters = static_cast<double>(space.dimension());
  for (std::size_t c = 0; c < places.channels; ++c) {
    const ChannelTerms& data = terms.channel[c];
    count += static_cast<double>(data.count);
    for (std::size_t row = 0; row < terms.rows(); ++row) size_of_terms += data.weight[row] * data.target[row] * data.target[row];
    for (const double held : profile.limits()[c].held) free_parameters += std::isnan(held);
  }
  solution.dof = count - free_parameters;
  const bool scale_known = terms.weighted || terms.pure_error || solution.dof >= 1;
  const double floor = rounding * rounding * size_of_terms;
  double constants = 0, informative = 0;
  for (const ChannelTerms& data : terms.channel) {
    constants += data.within;
    solution.signal_to_noise2 += data.weighted_value2;
    solution.count += data.count;
    informative += static_cast<double>(
        terms.collapsed ? std::count_if(data.weight.begin(), data.weight.end(), [](double w) { return w > 0; }) : data.count);
  }
  solution.chi2 = terms.pure_error ? solution.cost - constants : solution.cost;
  solution.chi2_dof = terms.pure_error ? informative - free_parameters : solution.dof;
  const bool misses = terms.pure_error && solution.chi2_dof >= 1 && chi2_upper_tail(solution.chi2, solution.chi2_dof) < significant;
  const bool absolute = terms.weighted || terms.pure_error;
  const double scale = misses     ? solution.chi2 / solution.chi2_dof
                       : absolute ? 1
                                  : std::max(solution.cost, floor) / std::max(1.0, solution.dof);
  const double q = absolute ? normal_upper_quantile((1 - options.confidence) / 2)
                            : student_two_sided_quantile(options.confidence, std::max(1.0, solution.dof));
  solution.budget = std::max(q * q * scale, floor);

  const auto linearised = [&](const CorrelatedComponent* component) {
    return linearise(terms, space, profile.limits(), solution.linear, solution.theta, component, options.threads);
  };
  Matrix own = covariance(linearised(nullptr), places, space, scale);
  solution.covariance = own;
  std::vector<double> shared(places.size(), 0.0);  // variance of the shared parts
  for (const CorrelatedComponent& component : correlated) {
    const std::vector<double> move = response(linearised(&component), places, space);
    for (std::size_t a = 0; a < places.size(); ++a) {
      shared[a] += move[a] * move[a];
      for (std::size_t b = 0; b < places.size(); ++b) solution.covariance(a, b) += move[a] * move[b];
    }
  }

  // The profile may lie a rounding error below or above the polished cost: the lower of the two is the floor.
  double least = solution.cost;
  for (const Minimum& minimum : found.minima) least = std::min(least, minimum.point.cost);
  std::vector<Reach> reach(places.size());
  if (scale_known && space.dimension() < 2) {
    reach = reach_on_line(solution, profile, space, found, places, least, options.threads);
  } else if (scale_known) {
    std::vector<Minimum> minima{{space.coordinates(solution.theta), profile.at(solution.theta, options.threads)}};
    minima.insert(minima.end(), found.minima.begin(), found.minima.end());
    reach = joint_reach(profile, space, minima, places, own, least, solution.budget, q, options.threads);
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
}

}  // namespace gonio::fitting
