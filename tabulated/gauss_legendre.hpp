// SPDX-License-Identifier: BSD-3-Clause
// Nodes and weights for the mean of a function over an interval.
#pragma once

#include <cstddef>
#include <vector>

namespace gonio::tabulated {

/// The Gauss-Legendre rule of `order` points on [0, 1]: exact for polynomials of degree 2 · order - 1; the weights sum to 1.
struct GaussLegendre {
  explicit GaussLegendre(std::size_t order);
  std::vector<double> nodes, weights;
};

}  // namespace gonio::tabulated
