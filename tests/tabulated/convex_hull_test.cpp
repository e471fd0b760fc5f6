// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/convex_hull.hpp"

#include <vector>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Convex combinations lie within, what a plane separates by more than the tolerance does not") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<PairPoint> points;
    PairPoint inside{};
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
      points.push_back({test::uniform(random, -2, 2), test::uniform(random, -2, 2), test::uniform(random, -2, 0), 0});
      const double w = test::uniform(random, 0, 1);
      for (std::size_t axis = 0; axis < 4; ++axis) inside[axis] += w * points.back()[axis];
      sum += w;
    }
    for (double& x : inside) x /= sum;
    CHECK(within_hull(inside, points, 0.1));
    CHECK(!within_hull({inside[0], inside[1], 0.5, 0}, points, 0.4));
  }
}

TEST_CASE("Close beyond the hull is within the tolerance, no points hold nothing") {
  const std::vector<PairPoint> square{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}};
  CHECK(within_hull({1.2, 0.5, 0, 0}, square, 0.3));
  CHECK(!within_hull({1.4, 0.5, 0, 0}, square, 0.3));
  CHECK(!within_hull({0, 0, 0, 0}, {}, 0.3));
}
