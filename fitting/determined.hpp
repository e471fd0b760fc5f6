// SPDX-License-Identifier: BSD-3-Clause
// What the data determine of a lobe whose parameters they do not.
#pragma once

#include <vector>

#include "fitting/covariance.hpp"
#include "fitting/line_intervals.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {

/// The solution to first order.
struct About {
  const Linearisation& linearisation;
  const ParameterPlaces& places;
  double scale, quantile;
  const std::vector<std::vector<double>>& moves;  ///< of all parameters by one standard uncertainty of every shared component
};

/// For every lobe and channel with a parameter that has no two-sided interval: the value of the lobe in its peak at normal incidence, if
/// that has one. Data that see a narrow lobe in its peak alone determine ρs norm(s), neither ρs nor s (numerics D.4).
/// With one nonlinear parameter free the interval is that of the profile, from `line`; with more (`line` null) the linearised one, if
/// the peak has no part in the null space. A lobe of several linear parameters that count in its peak is passed over.
void add_determined(Solution& solution, const Profile& profile, const SearchSpace& space, const LineIntervals* line, const About& about);

}  // namespace gonio::fitting
