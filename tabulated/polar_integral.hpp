// SPDX-License-Identifier: BSD-3-Clause
// The scatter of a table of zenith angles by azimuths.
#pragma once

#include <span>

namespace gonio::tabulated {

/// ∫ f |cos theta| dω by the trapezoidal rule over the nodes f[theta · azimuths + azimuth]; azimuths that leave out the end of the turn are
/// closed with the first one. 0 for fewer than two zenith angles; one azimuth stands for the whole turn.
double polar_integral(std::span<const double> theta_deg, std::span<const double> phi_deg, std::span<const double> f);

}  // namespace gonio::tabulated
