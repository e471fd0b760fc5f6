// SPDX-License-Identifier: BSD-3-Clause
// Outgoing directions by their projection on the surface, counted from that of the specular direction.
#pragma once

#include <optional>

#include "brdf/channels.hpp"
#include "brdf/coordinates.hpp"

namespace gonio::tabulated {

/// β - β0 of Harvey's model and of TracePro's tables: β and β0 are the outgoing and the specular direction projected on the surface.
struct BetaOffset {
  double length = 0;       ///< |β - β0|, 0 ... 2
  double azimuth_deg = 0;  ///< [0, 360), 0 forward, away from the light (phi_i + 180°), 180 back
};

/// The pose of β = β0 + length (cos a, sin a), `azimuth` a from the sample's x axis; nothing if it lies on the horizon or beyond.
/// In transmission theta_o is above 90°, and β0 goes straight on.
std::optional<GonioAngles> from_beta_offset(Angle theta_i, Angle phi_i, double length, Angle azimuth, Side side);

/// The opposite, for either side of the surface.
BetaOffset to_beta_offset(const Direction& wi, const Direction& wo);

}  // namespace gonio::tabulated
