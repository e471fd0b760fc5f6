// SPDX-License-Identifier: BSD-3-Clause
// Raw readings -> samples with uncertainty.
#pragma once

#include "acquisition/run.hpp"
#include "brdf/dataset.hpp"

namespace gonio::acquisition {

/// The relative measurement equation, white in its own pose, spot inside the receiver's field:
///   f_s = f_ref · (S_s - D_s)/(S_r - D_r) · (g_r t_r)/(g_s t_s) · K(pose_r)/K(pose_s),   K = Φ ∫ cos θo dΩ over the receiver.
/// Dark is interpolated in time per exposure, the source's drift between reference visits. Samples are reported at the read-back pose.
/// u is the independent part (shot, read and dark noise of this reading); shared parts are named components (certificate, reference
/// noise, the bench file's own). The last good attempt of a step counts. Error(input) if dark or reference readings are missing.
Dataset reduce(const Run& run);

/// ∫ cos θ dΩ over a disc of half-angle a about a direction at zenith angle theta, cut at the horizon [sr].
double projected_solid_angle(Angle theta, Angle half_angle);

}  // namespace gonio::acquisition
