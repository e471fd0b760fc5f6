// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals with one free nonlinear parameter at most.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fitting/global_search.hpp"
#include "fitting/joint_intervals.hpp"

namespace gonio::fitting {

/// The set of points of the axis within the budget, and what the linear parameters can be there.
class LineIntervals {
 public:
  /// `theta`: of the solution; the budget counts from `least`.
  LineIntervals(const Profile& profile, const SearchSpace& space, const Found& found, std::span<const double> theta, double least,
                double budget, int threads);

  /// The ends of the set on the axis: infinite where it has none before the search's own.
  Reach axis() const noexcept { return axis_; }
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
