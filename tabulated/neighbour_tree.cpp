// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/neighbour_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gonio::tabulated {
namespace {

constexpr std::size_t leaf_size = 32;

double squared_to_box(const PairPoint& at, const PairPoint& low, const PairPoint& high) {
  double sum = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double outside = std::max({low[k] - at[k], at[k] - high[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

double squared_to_far_corner(const PairPoint& at, const PairPoint& low, const PairPoint& high) {
  double sum = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double farther = std::max(at[k] - low[k], high[k] - at[k]);
    sum += farther * farther;
  }
  return sum;
}

/// A box or a point that waits for its turn.
struct Waiting {
  double squared;
  std::size_t index;
  bool is_point;
  bool operator<(const Waiting& other) const { return squared > other.squared; }  // the heap's top is the nearest
};

}  // namespace

NeighbourTree::NeighbourTree(std::vector<PairPoint> points) : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!points_.empty()) build(0, points_.size());
}

std::size_t NeighbourTree::build(std::size_t first, std::size_t last) {
  Node node{points_[order_[first]], points_[order_[first]], 0, first, last};
  for (std::size_t k = first; k < last; ++k)
    for (std::size_t axis = 0; axis < node.low.size(); ++axis) {
      node.low[axis] = std::min(node.low[axis], points_[order_[k]][axis]);
      node.high[axis] = std::max(node.high[axis], points_[order_[k]][axis]);
    }
  node.squared_diagonal = squared_distance(node.low, node.high);
  const std::size_t number = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= leaf_size) return number;
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < node.low.size(); ++axis)
    if (node.high[axis] - node.low[axis] > node.high[widest] - node.low[widest]) widest = axis;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) { return points_[a][widest] < points_[b][widest]; });
  const std::size_t left = build(first, middle), right = build(middle, last);
  nodes_[number].left = left;
  nodes_[number].right = right;
  return number;
}

void NeighbourTree::around(const PairPoint& at, const Search& search, std::vector<Neighbour>& out) const {
  out.clear();
  if (nodes_.empty()) return;
  thread_local std::vector<Waiting> heap;
  heap.clear();
  const double reach = search.reach * search.reach, hidden = search.hidden * search.hidden;
  const auto push = [&](double squared, std::size_t index, bool is_point) {
    if (!(squared <= reach)) return;
    heap.push_back({squared, index, is_point});
    std::push_heap(heap.begin(), heap.end());
  };
  push(squared_to_box(at, nodes_[0].low, nodes_[0].high), 0, false);
  while (!heap.empty() && out.size() < search.most) {
    std::pop_heap(heap.begin(), heap.end());
    const Waiting next = heap.back();
    heap.pop_back();
    if (next.is_point) {
      if (search.leave && (*search.leave)(next.index)) continue;
      const bool behind = std::any_of(out.begin(), out.end(), [&](const Neighbour& nearer) {
        return squared_distance(points_[nearer.point], points_[next.index]) < hidden * next.squared;
      });
      if (!behind) out.push_back({next.squared, next.index});
      continue;
    }
    const Node& node = nodes_[next.index];
    // The far corner of a box is half its diagonal away from any point.
    const bool may_hide = node.squared_diagonal < 4 * hidden * next.squared;
    if (may_hide && std::any_of(out.begin(), out.end(), [&](const Neighbour& nearer) {
          return squared_to_far_corner(points_[nearer.point], node.low, node.high) < hidden * next.squared;
        }))
      continue;
    if (node.left == 0) {
      for (std::size_t k = node.first; k < node.last; ++k) push(squared_distance(at, points_[order_[k]]), order_[k], true);
      continue;
    }
    for (const std::size_t child : {node.left, node.right}) push(squared_to_box(at, nodes_[child].low, nodes_[child].high), child, false);
  }
}

}  // namespace gonio::tabulated
