// SPDX-License-Identifier: BSD-3-Clause
// The order of a sweep's points.
#pragma once

#include <vector>

#include "acquisition/bench.hpp"
#include "acquisition/pose.hpp"

namespace gonio::acquisition {

struct PointOrder {
  std::vector<std::size_t> points;  ///< in the order of measuring
  std::vector<AxisAngles> axes;     ///< of each of them, the same length
  double travel_deg = 0;            ///< from the first point on: largest angle of any axis per move, summed
  double motion_s = 0;              ///< the same moves in time, which is what the order keeps short
  /// No order that finishes one incidence before the next has less: spanning trees of the outgoing directions of every incidence, and one
  /// of the incidences.
  double travel_bound_deg = 0, motion_bound_s = 0;
};

/// Incident-major: the light changes least often, since its arm is slow and heavy and moving it changes what lights the sample. Incidences
/// are put on a short path, the detector's directions within each on another (short_path.hpp), both by the time of the moves. Then, with
/// the order fixed, the solution of every point is chosen so that the whole sweep moves least (dynamic programming over the solutions).
/// `solutions[p]`: every set of axes that realises point p, at least one. `incident_axes`: those of the outer loop.
PointOrder order_points(const std::vector<std::vector<AxisAngles>>& solutions, const std::vector<std::size_t>& incident_axes,
                        const Bench& bench, const AxisAngles& start);

}  // namespace gonio::acquisition
