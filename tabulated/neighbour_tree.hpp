// SPDX-License-Identifier: BSD-3-Clause
// The points around a place, nearest first, without those that hide behind nearer ones.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "tabulated/pair_coordinates.hpp"

namespace gonio::tabulated {

struct Neighbour {
  double squared = 0;     ///< squared distance
  std::size_t point = 0;  ///< number of the point
};

/// A k-d tree with a box per node, searched best first. Immutable; safe to search from several threads.
class NeighbourTree {
 public:
  struct Search {
    std::size_t most = 20;                                    ///< points wanted
    double reach = std::numeric_limits<double>::infinity();   ///< none farther than this
    const std::function<bool(std::size_t)>* leave = nullptr;  ///< points to pass over
    /// A point p is hidden by a nearer one closer to p than this part of p's own distance: dense rows of samples then do not push out
    /// what lies farther off in the other directions. 0: none is hidden.
    double hidden = 0.5;
  };

  explicit NeighbourTree(std::vector<PairPoint> points);

  std::size_t size() const noexcept { return points_.size(); }
  const PairPoint& operator[](std::size_t point) const noexcept { return points_[point]; }
  /// In order of distance; ties in the order of the tree. `out` is overwritten.
  void around(const PairPoint& at, const Search& search, std::vector<Neighbour>& out) const;

 private:
  struct Node {
    PairPoint low, high;
    double squared_diagonal;
    std::size_t first, last;          ///< into order_
    std::size_t left = 0, right = 0;  ///< children; 0: a leaf
  };
  std::size_t build(std::size_t first, std::size_t last);

  std::vector<PairPoint> points_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gonio::tabulated
