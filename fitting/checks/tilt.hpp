// SPDX-License-Identifier: BSD-3-Clause
// A tilt of the sample's normal, estimated from contrasts through the slope of a fitted model, and taken out of them.
#pragma once

#include <optional>

#include "brdf/brdf.hpp"
#include "fitting/checks/contrasts.hpp"

namespace gonio::fitting {

/// What the tilt turns with. A normal that is tilted in the frame of the sample leaves exact partners equal, but moves poses that are the
/// same only up to a rotation; one that is tilted against the bench keeps its direction relative to the incident beam.
enum class TiltFrame { sample, plane_of_incidence };

struct Tilt {
  TiltFrame frame = TiltFrame::sample;
  double x_deg = 0, y_deg = 0;      ///< the normal is (tan x, tan y, 1) in the frame
  double u_x_deg = 0, u_y_deg = 0;  ///< standard uncertainties
  Contrasts corrected;              ///< readings turned back, with the remaining tilt as two free components

  double size_deg() const;
  double u_deg() const;  ///< of the size
};

/// The angles as the tilted sample sees them: both directions turned by the rotation that takes the normal back to z.
GonioAngles seen_by_tilted(const GonioAngles& angles, TiltFrame frame, double x_rad, double y_rad);

/// Gauss-Newton over the two angles: a reading f at nominal angles is F(turned angles), F the model, so that
/// f · F(nominal)/F(turned) is what an upright sample would give. None where the model has no slope that the contrasts can see, or the
/// estimate runs away (beyond 5°, where a fitted lobe says nothing).
std::optional<Tilt> estimate_tilt(const Contrasts& set, const Brdf& model, TiltFrame frame);

}  // namespace gonio::fitting
