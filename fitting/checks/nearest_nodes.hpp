// SPDX-License-Identifier: BSD-3-Clause
// The nearest of many points, by a k-d tree.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace gonio::fitting {

/// A pair of directions is a point in six dimensions (sample_places.hpp), a single one in three with the others zero.
using Point = std::array<double, 6>;

struct Neighbour {
  std::size_t node;
  double distance;
};

/// A balanced k-d tree (Bentley 1975): built once in n log n, each query in about log n.
class NearestNodes {
 public:
  explicit NearestNodes(std::vector<Point> points);

  using Skip = std::function<bool(std::size_t node)>;
  /// The `count` nearest points, nearest first, without those that `skip` names; fewer if there are fewer.
  std::vector<Neighbour> nearest(const Point& to, std::size_t count, const Skip& skip = {}) const;
  std::size_t size() const noexcept { return points_.size(); }
  const Point& point(std::size_t node) const { return points_[node]; }
  /// Median distance of a point to its nearest neighbour; 0 for fewer than two points.
  double median_spacing() const;

 private:
  void split(std::size_t begin, std::size_t end);
  struct Query;
  void visit(std::size_t begin, std::size_t end, Query& query) const;

  std::vector<Point> points_;
  std::vector<std::size_t> order_;         ///< the median of every range stands in its middle
  std::vector<unsigned char> split_axis_;  ///< of the range whose middle is there
};

}  // namespace gonio::fitting
