// SPDX-License-Identifier: BSD-3-Clause
// Readings of the same pair of directions.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/observations.hpp"

namespace gonio::fitting {

/// The numbers of two or more samples with the same two directions (to 1e-7; the azimuth at the pole does not matter).
using RepeatedReadings = std::vector<std::size_t>;

/// All of them; the samples of each ascending. Masked samples are left out.
std::vector<RepeatedReadings> repeated_readings(const Observations& observations);

}  // namespace gonio::fitting
