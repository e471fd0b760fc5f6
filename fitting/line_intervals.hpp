// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals with one free nonlinear parameter at most.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fitting/global_search.hpp"
#include "fitting/joint_intervals.hpp"

namespace gonio::fitting {

/// The ends on the axis of the set of points within the budget, from a scan of all rows and its minima; infinite where the set has no end
/// before the search's own.
Reach reach_on_scan(const Profile& profile, const SearchSpace& space, const Found& found, double least, double budget, int threads);

/// What the linear parameters can be over that set.
class LineIntervals {
 public:
  /// `axis`: the ends of the set, if there is an axis; `theta`: of the solution; the budget counts from `least`.
  LineIntervals(const Profile& profile, const SearchSpace& space, Reach axis, std::span<const double> theta, double least, double budget,
                int threads);

  /// A function of the nonlinear parameters.
  using Factor = std::function<double(const std::vector<double>&)>;
  /// The smallest and largest x_k, or x_k · factor, over all points of the set and all other linear parameters within the budget.
  Reach linear(std::size_t channel, std::size_t k, const Factor& factor = {}) const;

 private:
  double limit_;
  Reach axis_;
  ProfilePoint centre_;
  std::vector<ProfilePoint> nodes_;
};

}  // namespace gonio::fitting
