// SPDX-License-Identifier: BSD-3-Clause
// Directional albedo of basis functions that have no closed form.
#pragma once

#include "brdf/model_info.hpp"

namespace gonio {

/// ∫ basis_k cos theta_o dwo over the hemisphere, for every basis function of a model of the list.
///
/// Polar coordinates about the mirror direction of the incidence: panels that grow in proportion to their distance from the pole,
/// from 1e-7 rad to the horizon, with a Gauss-Legendre rule each, and the midpoint rule in azimuth, which converges geometrically for a
/// periodic integrand. So lobes of any width about the mirror direction are seen. Error: below 1e-3 relative for lobes wider than 1e-4 rad
/// up to 85° of incidence.
void numeric_albedo(const ModelInfo& model, Angle theta_i, Angle phi_i, const double* nonlinear, double* out);

}  // namespace gonio
