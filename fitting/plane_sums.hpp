// SPDX-License-Identifier: BSD-3-Clause
// Sums over planes of numbers as a table stores them: one pass at the speed of memory.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace gonio::fitting {

/// What is left of the values of one plane, in units of the stored numbers: their number, mean, centred sum of squares, least and most.
struct PlaneSums {
  double count = 0, mean = 0, within = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;  ///< of no values: the empty range
};

struct SummedPlanes {
  std::vector<PlaneSums> plane;
  std::size_t used = 0;      ///< samples with a value in some plane
  std::size_t negative = 0;  ///< samples dropped for a negative number
  std::size_t unknown = 0;   ///< the others without a value in some plane
};

/// `size` doubles from each of `planes`, which need not be aligned. NaN and the infinities are no values; with `drop_negative` a sample
/// with a negative number in any plane has none at all (MERL). The squares are summed about the mean of the first few values, in eight
/// lanes, so that nothing cancels and every machine gives the same bits.
SummedPlanes sum_planes(std::span<const std::byte* const> planes, std::size_t size, bool drop_negative);

}  // namespace gonio::fitting
