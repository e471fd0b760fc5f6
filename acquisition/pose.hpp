// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a bench: a pair of directions; and what its axes do for it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "brdf/coordinates.hpp"

namespace gonio::acquisition {

/// A measuring pose: the pair of directions in the sample frame.
using Pose = GonioAngles;

/// Angles of the axes in degrees, in the order of the bench file.
using AxisAngles = std::vector<double>;

}  // namespace gonio::acquisition
