// SPDX-License-Identifier: BSD-3-Clause
// Raw readings -> samples with uncertainty.
#pragma once

#include <vector>

#include "acquisition/run.hpp"
#include "brdf/dataset.hpp"

namespace gonio::acquisition {

/// The relative measurement equation, white in its own pose, spot inside the receiver's field:
///   f_s = f_ref · (S_s - D_s)/(S_r - D_r) · K(pose_r)/K(pose_s),   K = Φ ∫ cos θo dΩ over the receiver.
/// A meter that prints watts has divided by gain and exposure itself, so the general form's factor (g_r t_r)/(g_s t_s) is 1.
/// D is interpolated in time between dark steps of the same exposure and range, the source's drift between visits to the reference (mean of
/// the repeats of a visit). Samples stand at the read-back pose; the commanded one is kept beside it. The last good attempt counts.
///
/// u (independent): noise of this reading by the bench's stated noise model, or by one estimated from repeated readings (meter_noise.hpp),
/// and what its own two dark visits scatter beyond the mean of all dark visits. NaN where no noise is known. Named components
/// (shared): `certificate`; `reference_noise_1`, `_2`, ... of each visit to the white, with the share of it that a sample takes as
/// sensitivity (samples between the same two visits err together: a check of isotropy would see that as a difference of azimuths);
/// `dark_noise`, of the mean over all visits; `drift`, where the course between visits is
/// not straight; and those the bench file states. `dark_noise` is in W and has a sensitivity per sample. Column `var_read` [1/sr²] is u²
/// without the shot noise of the sample's own reading, which alone depends on f: what is needed to weight a fit by its model instead of by
/// noisy values. Further columns: time_s, step, range_w, exposure_s, rotation_deg, commanded_*_deg. Masked steps count as `blocked`, steps
/// without a good reading and unreachable ones as `missing`. Error(input) if dark or reference readings are missing, if the white is not
/// brighter than the dark, or if a reading does not fit the bench.
Dataset reduce(const Run& run);
Dataset reduce(const Bench& bench, const std::vector<PlanStep>& steps, const std::vector<Reading>& readings);

/// ∫ cos θ dΩ over a disc of half-angle a about a direction at zenith angle theta, cut at the horizon [sr].
double projected_solid_angle(Angle theta, Angle half_angle);

}  // namespace gonio::acquisition
