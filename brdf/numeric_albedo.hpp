// SPDX-License-Identifier: BSD-3-Clause
// Directional albedo of basis functions that have no closed form.
#pragma once

#include "brdf/model_info.hpp"

namespace gonio {

/// ∫ basis_k cos theta_o dwo over the hemisphere, for every basis function of a model of the list.
///
/// Over half vectors, dwo = 4 cos theta_d dwh, in polar coordinates about the normal, which is where the lobes about the mirror direction
/// peak whatever the incidence. Along theta_h Gauss-Legendre panels that double from 1e-7 rad up to the half vector whose wo lies in the
/// surface, which is known in closed form; along phi_h panels that narrow towards the directions across the plane of incidence, as the
/// cosine of the incidence does, because there the horizon comes near at grazing. Error: below 1e-3 relative for lobes wider than 1e-6 rad
/// up to 89° of incidence (a lobe with a kink at 90° from its axis: 5e-3). Lobes about other directions need a closed form, and of
/// anisotropic ones the widths must not differ by more than a factor of 15. About 0.3 ms, five times that for an anisotropic model.
void numeric_albedo(const ModelInfo& model, Angle theta_i, Angle phi_i, const double* nonlinear, double* out);

}  // namespace gonio
