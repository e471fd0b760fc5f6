// SPDX-License-Identifier: BSD-3-Clause
// Local minima of the profile over several nonlinear parameters.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fitting/profile.hpp"
#include "fitting/search_space.hpp"

namespace gonio::fitting {

struct Minimum {
  std::vector<double> z;  ///< on the axes of the search
  ProfilePoint point;
};

struct DescentOptions {
  std::optional<std::size_t> hold;  ///< an axis that stays where it is
  double tolerance = 0;             ///< stop when a step promises less than this decrease of the cost, beside rounding
  int most_steps = 60;
  int threads = 1;
};

/// Levenberg-Marquardt on the profile (the variable projection of Golub and Pereyra with Kaufman's derivative), on the axes of the search
/// and within their ends. Never ends above its start.
Minimum descend(const Profile& profile, const SearchSpace& space, std::span<const double> start, const DescentOptions& options = {});

}  // namespace gonio::fitting
