// SPDX-License-Identifier: BSD-3-Clause
// The triangles of all rows as a function of one nonlinear parameter, from their values at a few places.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fitting/linear_part.hpp"

namespace gonio::fitting {

/// Polynomials through the elements of the triangles R at Chebyshev's places on a stretch of the axis, in barycentric form (J.-P. Berrut,
/// L. N. Trefethen, Barycentric Lagrange Interpolation, SIAM Review 46(3), 2004). With a positive diagonal the elements are analytic in
/// the parameter as far as the basis is and its columns stay independent; the last, the root of the least cost of free linear parameters,
/// only between the complex zeros of that cost, so that its square is taken. The linear parameters keep all digits; the cost keeps
/// rounding errors of its largest value on the stretch.
class InterpolatedTriangles {
 public:
  struct Node {
    double place;                   ///< where on the axis these really are
    std::vector<Matrix> triangles;  ///< one per channel; from the constructor on with the last element squared
  };
  /// `at` gives the node next to a place; it is called from up to `threads` threads.
  InterpolatedTriangles(double low, double high, int threads, const std::function<Node(double place)>& at);

  bool covers(double place) const noexcept { return place >= node_.front().place && place <= node_.back().place; }
  std::vector<Matrix> at(double place) const;

 private:
  std::vector<Node> node_;  ///< in rising order
  std::vector<double> weight_;
};

}  // namespace gonio::fitting
