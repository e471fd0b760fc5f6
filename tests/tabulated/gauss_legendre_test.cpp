// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/gauss_legendre.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio::tabulated;

TEST_CASE("A rule of n points integrates powers up to 2n - 1 exactly and not the next") {
  for (const std::size_t order : {1u, 2u, 3u, 5u, 8u, 16u}) {
    const GaussLegendre rule(order);
    const auto error = [&](std::size_t power) {
      double sum = 0;
      for (std::size_t k = 0; k < order; ++k) sum += rule.weights[k] * std::pow(rule.nodes[k], power);
      return std::fabs(sum * static_cast<double>(power + 1) - 1);
    };
    for (std::size_t power = 0; power < 2 * order; ++power) CHECK(error(power) < 1e-13);
    if (order <= 5) CHECK(error(2 * order) > 1e-6);
  }
}
