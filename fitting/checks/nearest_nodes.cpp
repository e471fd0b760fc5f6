// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/nearest_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gonio::fitting {

struct NearestNodes::Query {
  const Point& to;
  std::size_t count;
  const Skip& skip;
  std::vector<Neighbour> found;  ///< a heap on squared distances, the farthest on top
};

namespace {

bool nearer(const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; }

}  // namespace

NearestNodes::NearestNodes(std::vector<Point> points) : points_(std::move(points)), order_(points_.size()), split_axis_(points_.size(), 0) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  split(0, order_.size());
}

void NearestNodes::split(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  Point low = points_[order_[begin]], high = low;
  for (std::size_t k = begin; k < end; ++k)
    for (std::size_t axis = 0; axis < low.size(); ++axis) {
      low[axis] = std::min(low[axis], points_[order_[k]][axis]);
      high[axis] = std::max(high[axis], points_[order_[k]][axis]);
    }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < low.size(); ++axis)
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) { return points_[a][widest] < points_[b][widest]; });
  split_axis_[middle] = static_cast<unsigned char>(widest);
  split(begin, middle);
  split(middle + 1, end);
}

void NearestNodes::visit(std::size_t begin, std::size_t end, Query& query) const {
  if (begin >= end) return;
  const std::size_t middle = begin + (end - begin) / 2, node = order_[middle], axis = split_axis_[middle];
  const Point& point = points_[node];
  if (!query.skip || !query.skip(node)) {
    double square = 0;
    for (std::size_t k = 0; k < point.size(); ++k) square += (point[k] - query.to[k]) * (point[k] - query.to[k]);
    if (query.found.size() < query.count) {
      query.found.push_back({node, square});
      std::push_heap(query.found.begin(), query.found.end(), nearer);
    } else if (square < query.found.front().distance) {
      std::pop_heap(query.found.begin(), query.found.end(), nearer);
      query.found.back() = {node, square};
      std::push_heap(query.found.begin(), query.found.end(), nearer);
    }
  }
  const double beyond = query.to[axis] - point[axis];
  const auto side = [&](bool left) { left ? visit(begin, middle, query) : visit(middle + 1, end, query); };
  side(beyond <= 0);
  if (query.found.size() < query.count || beyond * beyond < query.found.front().distance) side(beyond > 0);
}

std::vector<Neighbour> NearestNodes::nearest(const Point& to, std::size_t count, const Skip& skip) const {
  Query query{to, count, skip, {}};
  if (count > 0) visit(0, order_.size(), query);
  std::sort_heap(query.found.begin(), query.found.end(), nearer);
  for (Neighbour& neighbour : query.found) neighbour.distance = std::sqrt(neighbour.distance);
  return std::move(query.found);
}

double NearestNodes::median_spacing() const {
  if (points_.size() < 2) return 0;
  std::vector<double> spacing;
  for (std::size_t k = 0; k < points_.size(); ++k)
    spacing.push_back(nearest(points_[k], 1, [k](std::size_t node) { return node == k; }).front().distance);
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  return *middle;
}

}  // namespace gonio::fitting
