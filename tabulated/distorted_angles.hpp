// SPDX-License-Identifier: BSD-3-Clause
// Outgoing directions in polar coordinates whose pole is the specular direction and whose equator is the horizon.
#pragma once

#include "brdf/angle.hpp"
#include "brdf/direction.hpp"

namespace gonio::tabulated {

/// The "distorted spherical coordinates" of SSDD 0.3. The document names them only; this is what its library, libbsdf, does: the hemisphere
/// lies on the unit disk by its zenith angle, w -> theta / 90° (cos phi, sin phi), and there
///
///     disk(wo) = r (cos a, sin a) + (1 - r) disk(pole),   r = polar / 90°, a = azimuth,
///
/// so circles about the pole, at r = 0, become the horizon at r = 1. No node lies below the surface, whatever the incidence.
/// At polar 0 the azimuth is arbitrary.
/// Trap: the azimuth is one of the disk, not of the direction: 0 is the sample's +x axis at every incidence.
struct DistortedAngles {
  double polar_deg = 0;    ///< 0 … 90
  double azimuth_deg = 0;  ///< [0, 360)
};

/// The direction of a node. `pole` must be above the surface.
Direction from_distorted(const Direction& pole, const DistortedAngles& node);

/// The opposite, for directions above the surface.
DistortedAngles to_distorted(const Direction& pole, const Direction& wo);

}  // namespace gonio::tabulated
