// SPDX-License-Identifier: BSD-3-Clause
// Incidences on a short path, directions within each, solutions by dynamic programming.
#include "acquisition/ordering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "acquisition/short_path.hpp"
#include "acquisition/trapezoidal_motion.hpp"

namespace gonio::acquisition {
namespace {

using Solutions = std::vector<AxisAngles>;
using AxisList = std::vector<std::size_t>;

double move_time(const AxisAngles& from, const AxisAngles& to, const AxisList& axes, const Bench& bench) {
  double longest = 0;
  for (const std::size_t a : axes)
    longest = std::max(longest, move_duration_s(to[a] - from[a], bench.axes[a].speed_deg_per_s, bench.axes[a].acceleration_deg_per_s2));
  return longest;
}

double travel(const AxisAngles& from, const AxisAngles& to, const AxisList& axes) {
  double longest = 0;
  for (const std::size_t a : axes) longest = std::max(longest, std::abs(to[a] - from[a]));
  return longest;
}

/// The least of `cost` over every pair of solutions.
template <class Cost>
double least(const Solutions& from, const Solutions& to, Cost cost) {
  double best = std::numeric_limits<double>::infinity();
  for (const AxisAngles& a : from)
    for (const AxisAngles& b : to) best = std::min(best, cost(a, b));
  return best;
}

/// Points of one incidence, with those of their solutions that hold the incident axes still.
struct Incidence {
  std::vector<std::size_t> points;
  Solutions states;                  // the incident axes may stand like any of these
  std::vector<Solutions> solutions;  // of each point
};

AxisAngles part(const AxisAngles& axes, const AxisList& list) {
  AxisAngles out;
  for (const std::size_t a : list) out.push_back(axes[a]);
  return out;
}

std::vector<Incidence> incidences(const std::vector<Solutions>& solutions, const AxisList& incident_axes) {
  std::vector<Incidence> out;
  std::map<AxisAngles, std::size_t> index;
  for (std::size_t p = 0; p < solutions.size(); ++p) {
    const AxisAngles* first = &solutions[p].front();
    for (const AxisAngles& axes : solutions[p])
      if (part(axes, incident_axes) < part(*first, incident_axes)) first = &axes;
    const AxisAngles incident = part(*first, incident_axes);
    const auto [place, is_new] = index.emplace(incident, out.size());
    if (is_new) {
      out.emplace_back();
      out.back().states = solutions[p];
    }
    Incidence& incidence = out[place->second];
    incidence.points.push_back(p);
    incidence.solutions.emplace_back();
    for (const AxisAngles& axes : solutions[p])
      if (part(axes, incident_axes) == incident) incidence.solutions.back().push_back(axes);
  }
  return out;
}

/// For a fixed order, the solution of every point such that the sum of all moves from `start` on is least.
std::vector<AxisAngles> choose_solutions(const std::vector<std::size_t>& order, const std::vector<Solutions>& solutions,
                                         const AxisAngles& start, const AxisList& axes, const Bench& bench) {
  std::vector<std::vector<std::size_t>> came_from(order.size());
  Solutions before{start};
  std::vector<double> cost_before{0};
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Solutions& now = solutions[order[k]];
    std::vector<double> cost(now.size(), std::numeric_limits<double>::infinity());
    came_from[k].resize(now.size());
    for (std::size_t s = 0; s < now.size(); ++s)
      for (std::size_t b = 0; b < before.size(); ++b)
        if (const double c = cost_before[b] + move_time(before[b], now[s], axes, bench); c < cost[s]) cost[s] = c, came_from[k][s] = b;
    before = now;
    cost_before = std::move(cost);
  }
  std::vector<AxisAngles> out(order.size());
  std::size_t s = static_cast<std::size_t>(std::min_element(cost_before.begin(), cost_before.end()) - cost_before.begin());
  for (std::size_t k = order.size(); k-- > 0;) {
    out[k] = solutions[order[k]][s];
    s = came_from[k][s];
  }
  return out;
}

}  // namespace

PointOrder order_points(const std::vector<std::vector<AxisAngles>>& solutions, const std::vector<std::size_t>& incident_axes,
                        const Bench& bench, const AxisAngles& start) {
  PointOrder out;
  if (solutions.empty()) return out;
  AxisList all_axes, outgoing_axes;
  for (std::size_t a = 0; a < bench.axes.size(); ++a) {
    all_axes.push_back(a);
    if (std::find(incident_axes.begin(), incident_axes.end(), a) == incident_axes.end()) outgoing_axes.push_back(a);
  }
  const auto time_over = [&](const AxisList& axes) {
    return [&](const AxisAngles& a, const AxisAngles& b) { return move_time(a, b, axes, bench); };
  };
  const auto travel_over = [](const AxisList& axes) {
    return [&](const AxisAngles& a, const AxisAngles& b) { return travel(a, b, axes); };
  };

  const std::vector<Incidence> blocks = incidences(solutions, incident_axes);
  // Between two incidences of one point each (reciprocal partners) the detector's way counts too; a larger one can begin and end anywhere.
  const auto between = [&](std::size_t a, std::size_t b) -> const AxisList& {
    return blocks[a].points.size() == 1 && blocks[b].points.size() == 1 ? all_axes : incident_axes;
  };
  const auto block_order = short_path(
      blocks.size(), [&](std::size_t a, std::size_t b) { return least(blocks[a].states, blocks[b].states, time_over(between(a, b))); },
      [&](std::size_t a) { return least({start}, blocks[a].states, time_over(incident_axes)); });
  const auto add_to_bounds = [&](std::size_t n, auto solutions_of, auto axes_between) {
    out.travel_bound_deg += spanning_tree_length(
        n, [&](std::size_t a, std::size_t b) { return least(solutions_of(a), solutions_of(b), travel_over(axes_between(a, b))); });
    out.motion_bound_s += spanning_tree_length(
        n, [&](std::size_t a, std::size_t b) { return least(solutions_of(a), solutions_of(b), time_over(axes_between(a, b))); });
  };
  add_to_bounds(
      blocks.size(), [&](std::size_t b) -> const Solutions& { return blocks[b].states; }, between);

  Solutions last{start};
  for (const std::size_t b : block_order) {
    const Incidence& block = blocks[b];
    const auto path = short_path(
        block.points.size(),
        [&](std::size_t p, std::size_t q) { return least(block.solutions[p], block.solutions[q], time_over(outgoing_axes)); },
        [&](std::size_t p) { return least(last, block.solutions[p], time_over(outgoing_axes)); });
    for (const std::size_t p : path) out.points.push_back(block.points[p]);
    add_to_bounds(
        block.points.size(), [&](std::size_t p) -> const Solutions& { return block.solutions[p]; },
        [&](std::size_t, std::size_t) -> const AxisList& { return outgoing_axes; });
    last = block.solutions[path.back()];
  }
  out.axes = choose_solutions(out.points, solutions, start, all_axes, bench);
  for (std::size_t k = 1; k < out.axes.size(); ++k) {
    out.travel_deg += travel(out.axes[k - 1], out.axes[k], all_axes);
    out.motion_s += move_time(out.axes[k - 1], out.axes[k], all_axes, bench);
  }
  return out;
}

}  // namespace gonio::acquisition
