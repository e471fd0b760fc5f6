// SPDX-License-Identifier: BSD-3-Clause
// Every local minimum of the profile over the nonlinear parameters, without a start from the caller.
#pragma once

#include <vector>

#include "fitting/descent.hpp"

namespace gonio::fitting {

struct Found {
  std::vector<ProfilePoint>
      scan;  ///< along the axis, if there is one free parameter and few rows: their profile on equal steps from end to end of the search;
             ///< of many rows points on equal steps about the lowest minimum, up to where the cost is far above it
  std::vector<Minimum> minima;  ///< the lowest first; the point itself if nothing is free
};

/// One free parameter: the profile on 61 equal steps of its axis; every local minimum refined by Brent's method (R. P. Brent, Algorithms
/// for Minimization without Derivatives, 1973) to 1e-9. Ripples at the level of rounding are no minima; of a flat stretch the lower end
/// counts.
/// Two: a grid, its local minima refined by descent. More: a low-discrepancy sequence (generalised golden ratio), the best points far
/// from each other refined.
/// Of many rows a part (thinned) is searched, and the minima found there are refined on all: the lowest on a stretch of the one free axis,
/// which stays prepared in `profile` (stretch_search.hpp), all others by descent. Two minima without a barrier between them are one;
/// equal terms stand in order.
/// `known`: minima of nearly the same cost, under weights that have moved since; where the search is not a matter of few rows along one
/// axis they are refined and no others looked for.
Found search_globally(Profile& profile, const SearchSpace& space, int threads, std::vector<Minimum> known = {});

/// The search along the one free axis: the scan, and its minima refined to `tolerance` on the axis.
Found search_axis(const Profile& profile, const SearchSpace& space, int threads, double tolerance);
/// The minimum between two points of the one free axis (Brent), to 1e-9.
Minimum lowest_between(const Profile& profile, const SearchSpace& space, double low, double high, int threads);

}  // namespace gonio::fitting
