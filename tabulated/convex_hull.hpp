// SPDX-License-Identifier: BSD-3-Clause
// Whether a place lies among points or beyond them.
#pragma once

#include <span>

#include "tabulated/pair_coordinates.hpp"

namespace gonio::tabulated {

/// True if `at` is not farther than `tolerance` from the convex hull of `points`. By the iteration of E. G. Gilbert ("An iterative
/// procedure for computing the minimum of a quadratic form on a convex set", SIAM J. Control 4, 1966), which needs no hull to be built; a
/// place that it cannot decide about in its bounded number of steps, right at the tolerance, counts as within.
bool within_hull(const PairPoint& at, std::span<const PairPoint> points, double tolerance) noexcept;

}  // namespace gonio::tabulated
