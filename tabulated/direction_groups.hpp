// SPDX-License-Identifier: BSD-3-Clause
// Which of many directions are the same one.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/direction.hpp"

namespace gonio::tabulated {

struct DirectionGroups {
  std::vector<std::size_t> first;  ///< per group: the index of the direction that founded it
  std::vector<std::size_t> group;  ///< per direction: its group
};

/// A direction joins the first group whose founder is closer than `tolerance_rad`, in the order given. One pass over a hash of cells
/// as wide as the tolerance, so the time grows with the number of directions only.
DirectionGroups group_directions(const std::vector<Direction>& directions, double tolerance_rad);

}  // namespace gonio::tabulated
