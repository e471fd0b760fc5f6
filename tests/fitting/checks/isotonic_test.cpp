// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/isotonic.hpp"

#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

TEST_CASE("Violators are pooled by their weighted mean, falling values stay") {
  CHECK(non_increasing({5, 3, 3, 1}, {1, 1, 1, 1}) == std::vector<double>{5, 3, 3, 1});
  CHECK(non_increasing({1, 2, 3}, {1, 1, 2}) == std::vector<double>{2.25, 2.25, 2.25});
  CHECK(non_increasing({4, 1, 2, 0}, {1, 1, 3, 1}) == std::vector<double>{4, 1.75, 1.75, 0});
  CHECK(non_increasing({}, {}).empty());
}

TEST_CASE("No falling sequence is nearer") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> values, weights;
  for (int k = 0; k < 12; ++k) values.push_back(uniform(random) - .05 * k), weights.push_back(.5 + uniform(random));
  const auto best = non_increasing(values, weights);
  const auto distance = [&](const std::vector<double>& g) {
    double sum = 0;
    for (std::size_t k = 0; k < g.size(); ++k) sum += weights[k] * (values[k] - g[k]) * (values[k] - g[k]);
    return sum;
  };
  for (std::size_t k = 1; k < best.size(); ++k) CHECK(best[k] <= best[k - 1]);
  for (int trial = 0; trial < 2000; ++trial) {
    auto other = best;
    for (double& g : other) g += .05 * (uniform(random) - .5);
    CHECK(distance(non_increasing(other, weights)) >= distance(best));
  }
}
