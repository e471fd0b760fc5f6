// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/neighbour_tree.hpp"

#include <algorithm>
#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::vector<PairPoint> cloud(std::size_t count, test::Random& random) {
  std::vector<PairPoint> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back({test::uniform(random, 0, 9), test::uniform(random, 0, 9), test::uniform(random, 0, 9), test::uniform(random, 0, 2)});
  return out;
}

}  // namespace

TEST_CASE("Without hiding, the tree finds what trying every point finds") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const auto points = cloud(700, random);
  const NeighbourTree tree(points);
  for (const PairPoint& at : cloud(100, random)) {
    std::vector<Neighbour> found, wanted;
    tree.around(at, {.most = 12, .reach = 2, .hidden = 0}, found);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (const double d = squared_distance(at, points[k]); d <= 4) wanted.push_back({d, k});
    std::sort(wanted.begin(), wanted.end(), [](const Neighbour& a, const Neighbour& b) { return a.squared < b.squared; });
    wanted.resize(std::min<std::size_t>(wanted.size(), 12));
    REQUIRE(found.size() == wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k].point == wanted[k].point);
  }
}

TEST_CASE("Hiding is what trying every point in order of distance gives") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const auto points = cloud(700, random);
  const NeighbourTree tree(points);
  for (const PairPoint& at : cloud(50, random)) {
    std::vector<Neighbour> found, all;
    tree.around(at, {.most = 20, .hidden = 0.5}, found);
    tree.around(at, {.most = points.size(), .hidden = 0}, all);
    std::vector<std::size_t> wanted;
    for (const Neighbour& next : all) {
      const bool behind = std::any_of(wanted.begin(), wanted.end(), [&](std::size_t nearer) {
        return squared_distance(points[nearer], points[next.point]) < 0.25 * next.squared;
      });
      if (!behind && wanted.size() < 20) wanted.push_back(next.point);
    }
    REQUIRE(found.size() == wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k].point == wanted[k]);
  }
}

TEST_CASE("A dense row does not push out a lone point farther off in another direction") {
  std::vector<PairPoint> points;
  for (int k = 0; k < 200; ++k) points.push_back({1, 0.01 * (k - 100), 0, 0});
  points.push_back({-1.5, 0, 0, 0});
  std::vector<Neighbour> found;
  const auto holds_the_lone_one = [&] {
    return std::any_of(found.begin(), found.end(), [](const Neighbour& n) { return n.point == 200; });
  };
  NeighbourTree(points).around({0, 0, 0, 0}, {.most = 16}, found);
  CHECK(holds_the_lone_one());
  NeighbourTree(points).around({0, 0, 0, 0}, {.most = 16, .hidden = 0}, found);
  CHECK(!holds_the_lone_one());
}

TEST_CASE("Points to pass over are not found, an empty tree finds nothing") {
  const std::function<bool(std::size_t)> first = [](std::size_t k) { return k == 0; };
  std::vector<Neighbour> found;
  NeighbourTree({{0, 0, 0, 0}, {1, 0, 0, 0}}).around({0, 0, 0, 0}, {.leave = &first}, found);
  REQUIRE(found.size() == 1);
  CHECK(found[0].point == 1);
  NeighbourTree({}).around({0, 0, 0, 0}, {}, found);
  CHECK(found.empty());
}
