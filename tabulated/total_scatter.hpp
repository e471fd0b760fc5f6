// SPDX-License-Identifier: BSD-3-Clause
// Total integrated scatter of any BRDF at one incidence.
#pragma once

#include <vector>

#include "brdf/brdf.hpp"

namespace gonio::tabulated {

/// TIS = ∫ f |cos theta_o| dωo over the hemisphere of `side`, per channel: the part of the incident power that is scattered. A value that
/// is unknown counts as 0. In polar coordinates about the specular direction: radial Gauss-Legendre panels that double from 1e-4 rad up
/// to the horizon, which is known in closed form, 180 azimuths. Error below 1e-3 relative up to 85° of incidence for what is no
/// narrower than 1e-4 rad at the specular direction and than 5° elsewhere.
std::vector<double> total_scatter(const Brdf& brdf, Angle theta_i, Angle phi_i, Side side);

}  // namespace gonio::tabulated
