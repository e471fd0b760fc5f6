// SPDX-License-Identifier: BSD-3-Clause
// Poses that can be driven to but must not be measured, and why.
#pragma once

#include <optional>
#include <string>

#include "acquisition/bench.hpp"
#include "acquisition/pose.hpp"

namespace gonio::acquisition {

/// The reason, or none:
/// - a direction at or below the horizon of the sample;
/// - the detector head stands in the beam: angle(wi, wo) < asin((r_head + r_beam)/D) + margin, a cone about the retro direction;
/// - the spot, a disc across the beam, is an ellipse on the sample that is longer by 1/cos theta_i, and the field of view likewise by
///   1/cos theta_o. Only poses with the whole spot inside the field are measured: there K = Φ ∫cos theta_o dΩ (see reduce.hpp).
std::optional<std::string> pose_mask(const Bench& bench, const Pose& pose);

}  // namespace gonio::acquisition
