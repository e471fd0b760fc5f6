// SPDX-License-Identifier: BSD-3-Clause
// The poses that a plan asks for, each once, and what the bench says to them.
#pragma once

#include <optional>
#include <vector>

#include "acquisition/plan.hpp"

namespace gonio::acquisition {

struct PlanPoint {
  Pose pose;
  double rotation_deg = 0;
  StepState state = StepState::ok;
  std::string reason;
  std::optional<std::size_t> partner;  ///< the point with light and detector exchanged, exactly
  std::vector<AxisAngles> solutions;   ///< empty unless ok
};

/// (grid ∪ density ∪ reciprocal partners) × rotations. Angles are brought to theta >= 0, phi in (-180°, 180°] and rounded to 1 µdeg:
/// decimal numbers, so that exchanged pairs and rotated poses coincide exactly. Poses that are the same are one point.
///
/// A partner of (wi, wo) is the pose (wo, wi): the arms change places and the platform turns. Partners are added to
/// `reciprocity_pairs` points, drawn by the seed from those that are measurable at every rotation both ways and have none yet.
/// A rotation by a turns the sample under fixed arms: theta_i, theta_o and phi_o - phi_i stay, both azimuths grow by a.
std::vector<PlanPoint> plan_points(const PlanRequest& request, const Kinematics& kinematics);

}  // namespace gonio::acquisition
