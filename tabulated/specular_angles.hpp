// SPDX-License-Identifier: BSD-3-Clause
// Outgoing directions counted from the specular direction, as scatter programs store them.
#pragma once

#include "brdf/channels.hpp"
#include "brdf/coordinates.hpp"

namespace gonio::tabulated {

/// A direction as the Zemax tabular format names it (Zemax knowledge base, "Zemax Tabular BSDF data file format"): `radial` from the
/// specular direction (0 … 180°); `azimuth` about it, 0 from the specular direction towards the normal, counter-clockwise for who looks
/// against the specular ray. In transmission everything is mirrored at the surface: radial 0 is the directly transmitted direction.
/// At radial 0 and 180° the azimuth is arbitrary.
struct SpecularAngles {
  double radial_deg = 0, azimuth_deg = 0;  ///< azimuth in [0, 360)
};

/// The pose of a node. In the plane of incidence (azimuth 0 or 180°) the zenith angle is a sum of degrees, without rounding. theta_o
/// above 90° in reflection, or below it in transmission, is a node beyond the horizon.
GonioAngles from_specular(Angle theta_i, Angle phi_i, const SpecularAngles& node, Side side);

/// The opposite.
SpecularAngles to_specular(const Direction& wi, const Direction& wo, Side side);

/// How far it is from the specular direction to the horizon in direction `azimuth`: the radial angle at which cos theta_o vanishes.
Angle radial_of_horizon(Angle theta_i, Angle azimuth);

}  // namespace gonio::tabulated
