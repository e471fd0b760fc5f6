// SPDX-License-Identifier: BSD-3-Clause
// A short path through points whose distances are symmetric, and a lower bound of any such path.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace gonio::acquisition {

/// Distance of two points; symmetric, not negative.
using Distance = std::function<double(std::size_t, std::size_t)>;

/// Visits every point 0 .. n-1 once, from outside (`from_start`) to any end: nearest neighbour first, then 2-opt and Or-opt moves over the
/// nearest neighbours of each point until none helps (Lin, Kernighan, Oper. Res. 21, 1973; Or, thesis, Northwestern University 1976).
/// Deterministic; ties go to the lower number.
std::vector<std::size_t> short_path(std::size_t n, const Distance& distance, const std::function<double(std::size_t)>& from_start);

/// Length of the minimum spanning tree of the points (Prim): no path through all of them is shorter.
double spanning_tree_length(std::size_t n, const Distance& distance);

}  // namespace gonio::acquisition
