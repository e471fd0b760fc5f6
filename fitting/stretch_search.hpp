// SPDX-License-Identifier: BSD-3-Clause
// The lowest minimum along one axis from a few looks at all rows, where a part of them has shown about where it lies.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fitting/descent.hpp"

namespace gonio::fitting {

struct StretchFound {
  double low = 0, high = 0;  ///< ends of the stretch on the axis
  Minimum lowest;
  std::vector<ProfilePoint> scan;  ///< on equal steps from end to end
  double well_above = 0;           ///< a cost five standard deviations up: both ends reach it, or the search ends there

  bool covers(double z) const noexcept { return z >= low && z <= high; }
};

/// For one free parameter and a metric that is linear in f. `about`: a minimum found on `looked_at` of the rows, or on all of them under
/// nearly the same weights. All rows are prepared over a stretch about it (Profile::prepare) that is wide against the uncertainty of the
/// parameter and of the place; it moves along where the minimum lies at its end. None, with nothing prepared, where the data leave the
/// parameter open or where the interpolation differs from the rows by more than an interval can bear: data without noise.
std::optional<StretchFound> search_on_stretch(Profile& profile, const SearchSpace& space, const Minimum& about, std::size_t looked_at,
                                              int threads);

}  // namespace gonio::fitting
