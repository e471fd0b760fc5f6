// SPDX-License-Identifier: BSD-3-Clause
// Paths against the best of all orders and against the spanning tree.
#include "acquisition/short_path.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/check.hpp"

using gonio::acquisition::short_path;
using gonio::acquisition::spanning_tree_length;

namespace {

constexpr unsigned seed = 20260704;

struct Plane {
  std::vector<double> x, y;

  double distance(std::size_t a, std::size_t b) const { return std::hypot(x[a] - x[b], y[a] - y[b]); }
  double start(std::size_t a) const { return std::hypot(x[a], y[a]); }
  double length(const std::vector<std::size_t>& order) const {
    double sum = start(order[0]);
    for (std::size_t k = 1; k < order.size(); ++k) sum += distance(order[k - 1], order[k]);
    return sum;
  }
  std::vector<std::size_t> path() const {
    return short_path(
        x.size(), [&](std::size_t a, std::size_t b) { return distance(a, b); }, [&](std::size_t a) { return start(a); });
  }
};

Plane random_plane(std::size_t n, std::mt19937_64& random) {
  Plane plane;
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (std::size_t k = 0; k < n; ++k) plane.x.push_back(coordinate(random)), plane.y.push_back(coordinate(random));
  return plane;
}

}  // namespace

TEST_CASE("every point is visited once") {
  std::mt19937_64 random(seed);
  for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 150u}) {
    std::vector<std::size_t> path = random_plane(n, random).path(), all(n);
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::sort(path.begin(), path.end());
    CHECK(path == all);
  }
}

TEST_CASE("paths of eight points are the best of all orders or nearly") {
  std::mt19937_64 random(seed);
  double worst = 0;
  for (int round = 0; round < 40; ++round) {
    const Plane plane = random_plane(8, random);
    std::vector<std::size_t> order(8);
    std::iota(order.begin(), order.end(), std::size_t{0});
    double best = plane.length(order);
    while (std::next_permutation(order.begin(), order.end())) best = std::min(best, plane.length(order));
    INFO("seed " << seed << ", round " << round);
    CHECK(plane.length(plane.path()) >= best * (1 - 1e-12));
    worst = std::max(worst, plane.length(plane.path()) / best);
  }
  CHECK(worst < 1.10);
}

TEST_CASE("points on a line are walked along it and the tree is the line") {
  Plane line;
  for (const double x : {5.0, 1.0, 4.0, 2.0, 3.0}) line.x.push_back(x), line.y.push_back(0);
  CHECK(line.path() == std::vector<std::size_t>{1, 3, 4, 2, 0});
  CHECK(spanning_tree_length(5, [&](std::size_t a, std::size_t b) { return line.distance(a, b); }) == 4);
}

TEST_CASE("no path is shorter than the spanning tree, and a long one is improved") {
  std::mt19937_64 random(seed);
  const Plane plane = random_plane(600, random);
  const double tree = spanning_tree_length(600, [&](std::size_t a, std::size_t b) { return plane.distance(a, b); });
  const double length = plane.length(plane.path());
  CHECK(length > tree);
  // Nearest neighbour alone is about 25 % above the best path of random points; the best is about 1.12 times the tree.
  CHECK(length < 1.25 * tree);
}
