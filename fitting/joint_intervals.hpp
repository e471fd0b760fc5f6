// SPDX-License-Identifier: BSD-3-Clause
// Profile intervals where several nonlinear parameters are free.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "fitting/covariance.hpp"
#include "fitting/descent.hpp"

namespace gonio::fitting {

/// Ends of the values a parameter takes while the cost stays within the budget; infinite where there is no end before the search's own.
struct Reach {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

/// One reach per parameter in the order of `ParameterPlaces`: nonlinear ones on their axis, linear ones as they are (low 0: the bound is
/// reached); those that are not among the `asked` are left empty. Every end is approached along the path of least cost: the parameter is
/// held, all others are minimised again from where the path leads (first along the covariance), and √(cost - least), nearly linear in the
/// parameter, is brought to √budget by the secant rule. `minima`: the best first; those within the budget are starts too, so that the
/// hull covers them.
std::vector<Reach> joint_reach(const Profile& profile, const SearchSpace& space, const std::vector<Minimum>& minima,
                               const ParameterPlaces& places, std::span<const std::size_t> asked, const Matrix& covariance, double least,
                               double budget, double quantile, int threads);

}  // namespace gonio::fitting
