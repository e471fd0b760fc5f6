// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/line_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t interval_nodes = 33;      // across the interval of the nonlinear parameter, a parabola through the best three
constexpr std::size_t nodes_of_many_rows = 17;  // of an interval with two ends: an error of a thousandth of its width
constexpr double still_moving = 1e-3;           // part of its value that an end moves from node to node
constexpr std::size_t many_rows = 1000;         // worth several threads

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

/// The largest of values on equal steps, refined by the parabola through it and its neighbours.
double peak(const std::vector<double>& values) {
  const auto best = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  if (best == 0 || best + 1 == values.size()) return values[best];
  const double a = values[best - 1], b = values[best], c = values[best + 1], curvature = a - 2 * b + c;
  if (!std::isfinite(a) || !std::isfinite(c) || !(curvature < 0)) return b;
  return b - (a - c) * (a - c) / (8 * curvature);
}

}  // namespace

Reach reach_on_scan(const Profile& profile, const SearchSpace& space, const Found& found, double least, double budget, int threads) {
  const Line line{profile, space, threads};
  struct Node {
    double z, cost;
  };
  std::vector<Node> nodes;
  for (const ProfilePoint& point : found.scan) nodes.push_back({space.coordinates(point.theta).front(), point.cost});
  for (const Minimum& minimum : found.minima) nodes.push_back({minimum.z.front(), minimum.point.cost});
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.z < b.z; });
  const auto inside = [&](const Node& node) { return node.cost <= least + budget; };
  const auto first = std::find_if(nodes.begin(), nodes.end(), inside);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), inside);
  Reach reach;
  if (first == nodes.end()) return reach;
  if (first != nodes.begin()) {
    const auto before = first - 1;
    reach.low = end_of_interval(line, first->z, before->z, least, budget, before->cost);
  }
  if (last != nodes.rbegin()) {
    const auto after = last - 1;
    reach.high = end_of_interval(line, last->z, after->z, least, budget, after->cost);
  }
  return reach;
}

LineIntervals::LineIntervals(const Profile& profile, const SearchSpace& space, Reach axis, std::span<const double> theta, double least,
                             double budget, int threads)
    : limit_(least + budget), axis_(axis), centre_(profile.at(theta, threads)) {
  if (space.dimension() == 0) return;
  const double from = std::max(axis.low, space.axes().front().low), to = std::min(axis.high, space.axes().front().high);
  const bool closed = std::isfinite(axis.low) && std::isfinite(axis.high), many = profile.terms().rows() > many_rows;
  const std::size_t count = closed && many ? nodes_of_many_rows : interval_nodes;
  nodes_.resize(count);
  const Line alone{profile, space, 1};
  for_each_index(count, many ? threads : 1, [&](std::size_t k) {
    nodes_[k] = alone.at(from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1));
  });
}

Reach LineIntervals::linear(std::size_t channel, std::size_t k, const Factor& factor) const {
  const auto range_at = [&](const ProfilePoint& point) {
    const ChannelPart& part = point.channel[channel];
    Range range = range_of(part.system, k, limit_ - (point.cost - part.cost) - part.rest);
    if (factor && !range.empty()) range.low *= factor(point.theta), range.high *= factor(point.theta);
    return range;
  };
  const Range whole = range_at(centre_);
  if (nodes_.empty()) return {whole.low, whole.high};
  std::vector<double> falling, rising;
  for (const ProfilePoint& node : nodes_) {
    const Range at_node = range_at(node);
    falling.push_back(at_node.empty() ? -infinity : -at_node.low);
    rising.push_back(at_node.high);
  }
  // An end that is still on the move where the search stops and the set does not is no end.
  const auto open = [&](const std::vector<double>& values) {
    const std::size_t last = values.size() - 1;
    const auto moves = [&](std::size_t edge, std::size_t next) {
      return values[edge] >= *std::max_element(values.begin(), values.end()) &&
             std::abs(values[edge] - values[next]) > still_moving * std::abs(values[edge]);
    };
    return (std::isinf(axis_.low) && moves(0, 1)) || (std::isinf(axis_.high) && moves(last, last - 1));
  };
  return {open(falling) ? -infinity : std::min(whole.low, -peak(falling)), open(rising) ? infinity : std::max(whole.high, peak(rising))};
}

}  // namespace gonio::fitting
