// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gonio::tabulated {
namespace {

constexpr std::size_t axes = 6;
/// Two directions this near are the same measured one: the rounding of a direction made from its angles, with a margin.
constexpr double same_point = 1e-9;
constexpr double reach = DirectionTable::reach_deg * std::numbers::pi / 180;

double squared_distance(const std::array<double, axes>& a, const std::array<double, axes>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < axes; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

/// The nearest samples so far, in order of distance; one more than are used, for the radius.
struct DirectionTable::Nearest {
  struct Entry {
    double squared;
    std::size_t sample;
  };
  std::array<Entry, neighbours + 1> entries;
  std::size_t count = 0;

  double bound() const { return count < entries.size() ? reach * reach : std::min(reach * reach, entries[count - 1].squared); }
  void add(double squared, std::size_t sample) {
    if (!(squared < bound())) return;
    if (count < entries.size()) ++count;
    std::size_t at = count - 1;
    for (; at > 0 && entries[at - 1].squared > squared; --at) entries[at] = entries[at - 1];
    entries[at] = {squared, sample};
  }
};

DirectionTable::Point DirectionTable::point_of(const Direction& wi, const Direction& wo) const {
  if (!dataset_->symmetry.isotropic) return {wi.x(), wi.y(), wi.z(), wo.x(), wo.y(), wo.z()};
  const double r = std::hypot(wi.x(), wi.y());
  if (r < same_point) return {0, 0, wi.z(), std::hypot(wo.x(), wo.y()), 0, wo.z()};  // at the normal wo has no azimuth either
  const double c = wi.x() / r, s = wi.y() / r;
  const double across = c * wo.y() - s * wo.x();
  return {r, 0, wi.z(), c * wo.x() + s * wo.y(), dataset_->symmetry.bilateral ? std::fabs(across) : across, wo.z()};
}

void DirectionTable::sort(std::size_t first, std::size_t last, std::size_t axis) const {
  if (last - first < 2) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t k) { return tree_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(middle), at(last), [&](const Node& a, const Node& b) { return a.point[axis] < b.point[axis]; });
  sort(first, middle, (axis + 1) % axes);
  sort(middle + 1, last, (axis + 1) % axes);
}

void DirectionTable::search(const Point& at, std::size_t first, std::size_t last, std::size_t axis, Nearest& nearest) const {
  if (first >= last) return;
  const std::size_t middle = first + (last - first) / 2, next = (axis + 1) % axes;
  const double offset = at[axis] - tree_[middle].point[axis];
  nearest.add(squared_distance(at, tree_[middle].point), tree_[middle].sample);
  if (offset < 0)
    search(at, first, middle, next, nearest);
  else
    search(at, middle + 1, last, next, nearest);
  if (offset * offset >= nearest.bound()) return;
  if (offset < 0)
    search(at, middle + 1, last, next, nearest);
  else
    search(at, first, middle, next, nearest);
}

void DirectionTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  std::call_once(once_, [&] {
    tree_.reserve(dataset_->size());
    for (std::size_t k = 0; k < dataset_->size(); ++k) tree_.push_back({point_of(dataset_->angles[k].wi(), dataset_->angles[k].wo()), k});
    sort(0, tree_.size(), 0);
  });
  const std::size_t channel_count = dataset_->channels.size();
  const bool transmission = dataset_->side == Side::transmission;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    if (!(wi[k].z() > 0) || (!transmission && !(wo[k].z() > 0))) {
      for (std::size_t c = 0; c < channel_count; ++c) f[k * channel_count + c] = 0;
      continue;
    }
    Nearest nearest;
    search(point_of(wi[k], wo[k]), 0, tree_.size(), 0, nearest);
    const bool full = nearest.count == nearest.entries.size();
    const double radius = full ? std::sqrt(nearest.entries[neighbours].squared) : reach;
    const bool exact = nearest.count > 0 && nearest.entries[0].squared < same_point * same_point;
    for (std::size_t c = 0; c < channel_count; ++c) {
      double sum = 0, weights = 0;
      for (std::size_t n = 0; n < nearest.count; ++n) {
        const double value = dataset_->f[c][nearest.entries[n].sample], d = std::sqrt(nearest.entries[n].squared);
        if (std::isnan(value) || (exact && d >= same_point)) continue;
        // Equally distant samples all lie on the radius: a floor of one millionth keeps them from having no weight at all.
        constexpr double least = 1e-6;
        const double w = exact ? 1 : std::max((radius - d) / radius, least) / d;
        sum += w * w * value;
        weights += w * w;
      }
      f[k * channel_count + c] = weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace gonio::tabulated
