// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/gauss_legendre.hpp"

#include <cmath>
#include <numbers>

namespace gonio::tabulated {

GaussLegendre::GaussLegendre(std::size_t order) {
  const auto n = static_cast<double>(order);
  for (std::size_t k = 0; k < order; ++k) {
    // Newton's method on P_n, from the asymptotic place of its zero; the derivative is n (x P_n - P_{n-1}) / (x² - 1).
    double x = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, value = x;
      for (std::size_t j = 2; j <= order; ++j) {
        const auto degree = static_cast<double>(j);
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
        before = value, value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back(0.5 * (1 + x));
    weights.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

}  // namespace gonio::tabulated
