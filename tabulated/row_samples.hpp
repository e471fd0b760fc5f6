// SPDX-License-Identifier: BSD-3-Clause
// Rows of one value each, made into samples with a value per channel.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::tabulated {

/// One value of a file that has a row for every direction and channel.
struct ValueRow {
  GonioAngles angles;
  std::size_t channel = 0;
  double f = 0;                                         ///< 1/sr
  double u = std::numeric_limits<double>::quiet_NaN();  ///< 1/sr, NaN = unknown
};

struct RowSamples {
  Dataset samples;                     ///< angles, f and u (empty if no row knows it) only; channels as given
  std::vector<std::size_t> sample_of;  ///< per row: the sample it went into
};

/// One sample for every direction (equal angles in degrees), in the order of first appearance; NaN where a direction has no value of a
/// channel. Repeats of the same direction and channel become samples of their own.
RowSamples samples_of_rows(const std::vector<ValueRow>& rows, Channels channels);

}  // namespace gonio::tabulated
