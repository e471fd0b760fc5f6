// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/nearest_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

std::vector<Point> random_points(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Point> points(n);
  for (Point& point : points)
    for (double& x : point) x = uniform(random);
  return points;
}

double distance(const Point& a, const Point& b) {
  double square = 0;
  for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

}  // namespace

TEST_CASE("The tree finds the same neighbours as looking at every point") {
  const auto points = random_points(500, 3), queries = random_points(100, 4);
  const NearestNodes tree(points);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::vector<double> all;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != q) all.push_back(distance(points[k], queries[q]));
    std::sort(all.begin(), all.end());
    const auto found = tree.nearest(queries[q], 7, [q](std::size_t node) { return node == q; });
    REQUIRE(found.size() == 7);
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(found[k].distance == all[k]);
      CHECK(found[k].node != q);
    }
  }
}

TEST_CASE("Equal points, few points and no points are no trouble") {
  const NearestNodes none({}), same(std::vector<Point>(20, Point{1, 2, 3, 4, 5, 6}));
  CHECK(none.nearest({}, 3).empty());
  CHECK(none.median_spacing() == 0);
  CHECK(same.nearest({}, 50).size() == 20);
  CHECK(same.median_spacing() == 0);
}
