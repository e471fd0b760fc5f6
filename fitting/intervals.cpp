// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals, covariance and correlated components.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/distributions.hpp"
#include "fitting/solution.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t interval_nodes = 33;  // across the interval of s, a parabola through the best three
constexpr double rounding = 1e-13;          // of the terms themselves: a perfect fit still has this much uncertainty
constexpr std::size_t rows_at_once = 256;
constexpr double dependent = 1e-10;  // a column whose own part is below this part of its length determines nothing

/// The end of the interval of log s between a point inside and a point outside the budget: root of √(P - P_min) = √budget, which is
/// nearly linear in log s, by the Illinois form of the secant rule.
double end_of_interval(const Profile& profile, double inside, double outside, double least, double budget, double outside_cost) {
  const auto excess = [&](double cost) { return std::sqrt(std::max(0.0, cost - least)) - std::sqrt(budget); };
  double a = inside, fa = excess(profile.at(std::exp(inside)).cost), b = outside, fb = excess(outside_cost);
  if (!(fa < 0)) return inside;
  for (int step = 0; step < 60; ++step) {
    double x = std::isfinite(fb) ? b - fb * (b - a) / (fb - fa) : 0.5 * (a + b);
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    const double fx = excess(profile.at(std::exp(x)).cost);
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

struct ExponentRange {
  double low = -infinity, high = infinity;  ///< of log s; infinite where the data give no end
  double from = 0, to = 0;                  ///< the finite stretch that was looked at
};

ExponentRange exponent_range(const Profile& profile, const std::vector<ProfilePoint>& scan, const std::vector<Minimum>& minima,
                             double least, double budget) {
  struct Node {
    double log_s, cost;
  };
  std::vector<Node> nodes;
  for (const ProfilePoint& point : scan) nodes.push_back({std::log(point.s), point.cost});
  for (const Minimum& minimum : minima) nodes.push_back({minimum.log_s, minimum.point.cost});
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.log_s < b.log_s; });
  const auto inside = [&](const Node& node) { return node.cost <= least + budget; };
  const auto first = std::find_if(nodes.begin(), nodes.end(), inside);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), inside);
  ExponentRange range;
  range.from = nodes.front().log_s, range.to = nodes.back().log_s;
  if (first == nodes.end()) return range;
  if (first != nodes.begin()) {
    const auto before = first - 1;
    range.low = range.from = end_of_interval(profile, first->log_s, before->log_s, least, budget, before->cost);
  }
  if (last != nodes.rbegin()) {
    const auto after = last - 1;
    range.high = range.to = end_of_interval(profile, last->log_s, after->log_s, least, budget, after->cost);
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

/// The joint linearisation at the solution. Free linear parameters above zero, then s where it is free and has an effect.
struct Linearised {
  std::vector<std::vector<std::size_t>> columns;  ///< [channel]: which linear parameters stand in its triangle
  std::vector<Matrix> r;                          ///< [channel]: columns (x…, s, shift)
  bool with_s = false;
  double information_s = 0;  ///< of s, all channels, the linear parameters eliminated
};

Linearised linearise(const Solution& solution, const Terms& terms, const SolveOptions& options, const CorrelatedComponent* component) {
  Linearised out;
  out.with_s = terms.kernel.nonlinear > 0 && std::isnan(options.held_s);
  const std::size_t rows = terms.rows(), linear = terms.kernel.linear;
  std::vector<double> basis(linear * rows), slopes(linear * rows);
  terms.kernel.basis_and_slopes(terms.geometry, &solution.s, basis.data(), slopes.data(), rows);
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    const ChannelTerms& data = terms.channel[c];
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < linear; ++k)
      if (std::isnan(options.held[c][k]) && solution.linear[c][k] > 0) columns.push_back(k);
    const std::size_t n = columns.size();
    Triangle triangle(n + 2);
    Matrix block(rows_at_once, n + 2);
    for (std::size_t begin = 0; begin < rows; begin += rows_at_once) {
      const std::size_t size = std::min(rows_at_once, rows - begin);
      for (std::size_t j = 0; j < size; ++j) {
        const std::size_t row = begin + j;
        const double root = std::sqrt(data.weight[row]), cos_i = terms.geometry[row].cos_i;
        double f = 0, by_s = 0;
        for (std::size_t k = 0; k < linear; ++k) {
          f += solution.linear[c][k] * basis[k * rows + row];
          by_s += solution.linear[c][k] * slopes[k * rows + row];
        }
        const double slope = root > 0 && (terms.transform.linear() || f > 0) ? root * terms.transform.slope(f, cos_i) : 0;
        for (std::size_t k = 0; k < n; ++k) block(j, k) = slope * basis[columns[k] * rows + row];
        block(j, n) = slope * by_s;
        double shift = 0;  // change of φ(f) by one standard uncertainty of the component
        if (component && root > 0) {
          const double measured = terms.transform.inverse(data.target[row], cos_i);
          const double sensitivity = component->sensitivity.empty() ? 1 : component->sensitivity[terms.sample[row]];
          if (measured != 0) shift = root * terms.transform.slope(measured, cos_i) * measured * sensitivity * component->u;
        }
        block(j, n + 1) = std::isfinite(shift) ? shift : 0;
      }
      triangle.add(block, size);
    }
    const Matrix& r = triangle.r();
    if (std::abs(r(n, n)) > dependent * length(r.column(n))) out.information_s += r(n, n) * r(n, n);
    out.columns.push_back(std::move(columns));
    out.r.push_back(r);
  }
  return out;
}

/// The inverse of the triangle of one channel's linear parameters; none if they are dependent.
std::optional<Eigen::MatrixXd> inverse_of(const Matrix& r, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k)
    if (!(std::abs(r(k, k)) > dependent * length(r.column(k)))) return std::nullopt;
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::Map<const Eigen::MatrixXd> all(r.data(), static_cast<Eigen::Index>(r.rows()), static_cast<Eigen::Index>(r.columns()));
  const Eigen::MatrixXd upper = all.topLeftCorner(size, size);
  return upper.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(size, size));
}

Eigen::VectorXd head(std::span<const double> column, std::size_t n) {
  return Eigen::Map<const Eigen::VectorXd>(column.data(), static_cast<Eigen::Index>(n));
}

/// Covariance per channel of (x, s), NaN where a parameter has none.
std::vector<Matrix> covariance(const Linearised& at, std::size_t linear, double scale) {
  std::vector<Matrix> out;
  const bool s_known = at.with_s && at.information_s > 0;
  const double var_s = s_known ? scale / at.information_s : 0;
  for (std::size_t c = 0; c < at.r.size(); ++c) {
    const std::vector<std::size_t>& columns = at.columns[c];
    const std::size_t n = columns.size();
    Matrix full(linear + 1, linear + 1, std::numeric_limits<double>::quiet_NaN());
    if (s_known) full(linear, linear) = var_s;
    // Without information on s a linear parameter that moves with it has none either.
    const bool moves = at.with_s && !s_known && length(at.r[c].column(n)) > 0;
    const auto inverse = inverse_of(at.r[c], n);
    if (inverse && n > 0 && !moves) {
      const Eigen::VectorXd coupling = *inverse * head(at.r[c].column(n), n);
      const Eigen::MatrixXd block = scale * *inverse * inverse->transpose() + var_s * coupling * coupling.transpose();
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b)
          full(columns[a], columns[b]) = block(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        if (s_known) full(columns[a], linear) = full(linear, columns[a]) = -var_s * coupling[static_cast<Eigen::Index>(a)];
      }
    }
    out.push_back(std::move(full));
  }
  return out;
}

/// How one standard uncertainty of the component moves the parameters, per channel (x, s).
std::vector<std::vector<double>> response(const Linearised& at, std::size_t linear) {
  double move_s = 0;
  if (at.with_s && at.information_s > 0) {
    for (const Matrix& r : at.r) move_s += r(r.columns() - 2, r.columns() - 2) * r(r.columns() - 2, r.columns() - 1);
    move_s /= at.information_s;
  }
  std::vector<std::vector<double>> out;
  for (std::size_t c = 0; c < at.r.size(); ++c) {
    const std::size_t n = at.columns[c].size();
    std::vector<double> move(linear + 1, 0.0);
    if (const auto inverse = inverse_of(at.r[c], n); inverse && n > 0) {
      const Eigen::VectorXd x = *inverse * (head(at.r[c].column(n + 1), n) - head(at.r[c].column(n), n) * move_s);
      for (std::size_t k = 0; k < n; ++k) move[at.columns[c][k]] = x[static_cast<Eigen::Index>(k)];
    }
    move[linear] = move_s;
    out.push_back(std::move(move));
  }
  return out;
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

}  // namespace

void estimate(Solution& solution, const Terms& terms, const Profile& profile, const std::vector<ProfilePoint>& scan,
              const std::vector<Minimum>& minima, const SolveOptions& options, const std::vector<CorrelatedComponent>& correlated) {
  const std::size_t linear = terms.kernel.linear, channels = terms.channel.size();
  const bool free_s = terms.kernel.nonlinear > 0 && std::isnan(options.held_s);
  double count = 0, size_of_terms = 0, free_parameters = free_s ? 1 : 0;
  for (std::size_t c = 0; c < channels; ++c) {
    const ChannelTerms& data = terms.channel[c];
    count += static_cast<double>(data.count);
    for (std::size_t row = 0; row < terms.rows(); ++row) size_of_terms += data.weight[row] * data.target[row] * data.target[row];
    for (const double held : options.held[c]) free_parameters += std::isnan(held);
  }
  solution.dof = count - free_parameters;
  const bool scale_known = terms.weighted || solution.dof >= 1;
  const double floor = rounding * rounding * size_of_terms;
  const double scale = terms.weighted ? 1 : std::max(solution.cost, floor) / std::max(1.0, solution.dof);
  const double q = terms.weighted ? normal_upper_quantile((1 - options.confidence) / 2)
                                  : student_two_sided_quantile(options.confidence, std::max(1.0, solution.dof));
  solution.budget = std::max(q * q * scale, floor);

  solution.covariance = covariance(linearise(solution, terms, options, nullptr), linear, scale);
  std::vector<std::vector<double>> shared(channels, std::vector<double>(linear + 1, 0.0));  // variance of the shared parts
  for (const CorrelatedComponent& component : correlated) {
    const auto moves = response(linearise(solution, terms, options, &component), linear);
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t a = 0; a <= linear; ++a) {
        shared[c][a] += moves[c][a] * moves[c][a];
        for (std::size_t b = 0; b <= linear; ++b) solution.covariance[c](a, b) += moves[c][a] * moves[c][b];
      }
  }

  // The profile may lie a rounding error below or above the polished cost: the lower of the two is the floor.
  double least = solution.cost;
  for (const Minimum& minimum : minima) least = std::min(least, minimum.point.cost);
  ExponentRange range;
  if (free_s) {
    if (scale_known) range = exponent_range(profile, scan, minima, least, solution.budget);
    const double value = std::log(solution.s);
    // Shared components act on s itself; in log s, where the interval is formed, divided by s.
    const double extra = q * std::sqrt(shared[0][linear]) / solution.s;
    const double low = scale_known ? range.low : -infinity, high = scale_known ? range.high : infinity;
    Estimate log_s = classify(value, low, high, extra, -infinity, solution.covariance[0](linear, linear));
    log_s.value = solution.s;
    if (log_s.low) log_s.low = std::exp(*log_s.low);
    if (log_s.high) log_s.high = std::exp(*log_s.high);
    solution.s_estimate = log_s;
  } else if (terms.kernel.nonlinear > 0) {
    solution.s_estimate = fixed_at(options.held_s);
  }

  std::vector<ProfilePoint> nodes;
  if (free_s && scale_known) {
    nodes.resize(interval_nodes);
    for_each_index(interval_nodes, terms.rows() > 1000 ? options.threads : 1, [&](std::size_t k) {
      nodes[k] = profile.at(std::exp(range.from + (range.to - range.from) * static_cast<double>(k) / (interval_nodes - 1)));
    });
  }
  const ProfilePoint centre = profile.at(solution.s);
  solution.linear_estimate.assign(channels, {});
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t k = 0; k < linear; ++k) {
      if (!std::isnan(options.held[c][k])) {
        solution.linear_estimate[c].push_back(fixed_at(options.held[c][k]));
        continue;
      }
      const auto range_at = [&](const ProfilePoint& point) {
        const ChannelPart& part = point.channel[c];
        return range_of(part.system, k, least + solution.budget - (point.cost - part.cost) - part.rest);
      };
      Range whole{0, infinity};
      if (scale_known) {
        whole = range_at(centre);
        std::vector<double> falling, rising;
        for (const ProfilePoint& node : nodes) {
          const Range at_node = range_at(node);
          falling.push_back(at_node.empty() ? -infinity : -at_node.low);
          rising.push_back(at_node.high);
        }
        if (!nodes.empty()) whole = {std::max(0.0, std::min(whole.low, -peak(falling))), std::max(whole.high, peak(rising))};
      }
      const double upper = terms.kernel.info->parameters[k].upper;
      if (whole.high >= upper) whole.high = infinity;
      solution.linear_estimate[c].push_back(
          classify(solution.linear[c][k], whole.low, whole.high, q * std::sqrt(shared[c][k]), 0, solution.covariance[c](k, k)));
    }
}

}  // namespace gonio::fitting
