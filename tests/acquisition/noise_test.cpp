// SPDX-License-Identifier: BSD-3-Clause
// Noise by hash of a key.
#include "acquisition/simulated/noise.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/check.hpp"

using namespace gonio::acquisition::simulated;

TEST_CASE("A deviate belongs to its key, and every word of the key counts") {
  CHECK(normal_deviate({1, 2, 3}) == normal_deviate({1, 2, 3}));
  CHECK(hash({1, 2, 3}) != hash({1, 3, 2}));
  CHECK(hash({0}) != hash({0, 0}));
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t step = 0; step < 100; ++step) {
      for (std::uint64_t repeat = 0; repeat < 10; ++repeat) seen.insert(hash({seed, step, repeat}));
    }
  }
  CHECK(seen.size() == 10 * 100 * 10);
}

TEST_CASE("Deviates of neighbouring keys are independent and normal") {
  constexpr int n = 200'000;
  double sum = 0, squares = 0, fourth = 0, neighbours = 0, last = 0;
  int beyond_two = 0;
  for (int k = 0; k < n; ++k) {
    const double x = normal_deviate({42, static_cast<std::uint64_t>(k)});
    REQUIRE(std::isfinite(x));
    sum += x, squares += x * x, fourth += x * x * x * x, neighbours += x * last;
    beyond_two += std::abs(x) > 2;
    last = x;
  }
  // Five standard deviations of each statistic: a false alarm in less than a millionth of the keys.
  const double sigma = 5 / std::sqrt(n);
  CHECK(std::abs(sum / n) < sigma);
  CHECK(std::abs(squares / n - 1) < sigma * std::sqrt(2.0));
  CHECK(std::abs(fourth / n - 3) < sigma * std::sqrt(96.0));
  CHECK(std::abs(neighbours / n) < sigma);
  CHECK(std::abs(static_cast<double>(beyond_two) / n - 0.0455003) < sigma * std::sqrt(0.0455 * 0.9545));
}
