// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/sample_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "tabulated/neighbour_tree.hpp"

namespace gonio::tabulated {
namespace {

constexpr double same_incidence = 0.5 * std::numbers::pi / 180;
constexpr double same_point = 1e-6;
/// Without a second incidence or a second sample: the step of a coarse plan.
constexpr double unknown_step = 10 * std::numbers::pi / 180;
/// With fewer samples per incidence, or incidences closer than this many times the tolerance, samples are scattered.
constexpr std::size_t gridded_samples = 6;
constexpr double gridded_step = 3 * same_incidence;
/// Samples whose nearest one is looked for: enough for a median.
constexpr std::size_t most_tried = 512;

double median(std::vector<double> values, double otherwise) {
  if (values.empty()) return otherwise;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Distances from some of the points to the nearest one that is not the same.
std::vector<double> nearest_steps(const std::vector<PairPoint>& points) {
  const NeighbourTree tree(points);
  std::vector<double> out;
  std::vector<Neighbour> found;
  const std::size_t stride = 1 + points.size() / most_tried;
  for (std::size_t k = 0; k < points.size(); k += stride) {
    const std::function<bool(std::size_t)> same = [&](std::size_t other) {
      return squared_distance(points[other], points[k]) < same_point * same_point;
    };
    tree.around(points[k], {.most = 1, .leave = &same, .hidden = 0}, found);
    if (!found.empty()) out.push_back(std::sqrt(found[0].squared));
  }
  return out;
}

}  // namespace

SampleSpacing sample_spacing(const std::vector<PairPoint>& samples) {
  SampleSpacing out;
  std::vector<PairPoint> founders, within(samples.size());
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells;  // founders by their cell
  out.incidence.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PairPoint t{0, 0, samples[k][2], samples[k][3]};
    const long x = std::lround(t[2] / same_incidence), y = std::lround(t[3] / same_incidence);
    std::size_t group = founders.size();
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        if (const auto cell = cells.find({x + dx, y + dy}); cell != cells.end())
          for (const std::size_t founder : cell->second)
            if (founder < group && squared_distance(founders[founder], t) < same_incidence * same_incidence) group = founder;
    if (group == founders.size()) {
      founders.push_back(t);
      cells[{x, y}].push_back(group);
    }
    out.incidence.push_back(group);
    // Far apart along one more axis, the incidences keep to themselves.
    within[k] = {samples[k][0], samples[k][1], 100 * static_cast<double>(group), 0};
  }
  out.incidences = founders.size();
  out.t = median(nearest_steps(founders), unknown_step);
  out.gridded = samples.size() >= gridded_samples * founders.size() && out.t > gridded_step;
  if (out.gridded) {
    out.s = median(nearest_steps(within), unknown_step);
  } else {
    out.s = out.t = median(nearest_steps(samples), unknown_step);
  }
  return out;
}

}  // namespace gonio::tabulated
