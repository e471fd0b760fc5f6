// SPDX-License-Identifier: BSD-3-Clause
// The directions at which a BRDF is sampled for a format that leaves them open.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/channels.hpp"
#include "brdf/coordinates.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// A product of four increasing lists in degrees. No direction is at the horizon (the last zenith angle is 89): f there is the limit of
/// a ratio, and models give 0. Every theta_i is also a theta_o and 180 is among the azimuths, so the mirror direction is a node.
struct DirectionGrid {
  std::vector<double> theta_i_deg, phi_i_deg;
  std::vector<double> theta_o_deg;
  std::vector<double> phi_deg;  ///< phi_o - phi_i; all of [0, 360) if the azimuths are a full turn, 0 to 180 with both ends if half of one

  std::size_t size() const noexcept { return theta_i_deg.size() * phi_i_deg.size() * theta_o_deg.size() * phi_deg.size(); }
  /// Every pair once, theta_i outermost, then phi_i, theta_o, phi_o: the normal has one azimuth only, so that there are a few less than
  /// `size()`. phi_o is phi_i + phi in [0, 360).
  std::vector<GonioAngles> pairs() const;
};

/// Steps in degrees and the resulting number of pairs:
///   size       theta_i  theta_o  phi away from and at the mirror direction   pairs, isotropic and bilateral
///   paper      10       5        15 and 2                                    3 420
///   standard   5        2.5      7.5 and 1                                   21 090
///   fine       2.5      1.25     5 and 0.5                                   116 143
/// Isotropic sources have the one phi_i 0, bilateral ones half a turn of azimuths. Others take phi_i every 45, 30 and 15 degrees and
/// phi every 15, 5 and 5, evenly: phi_o then takes the same values at every phi_i, so that incident by outgoing directions are a table.
DirectionGrid direction_grid(GridSize size, const Symmetry& symmetry);

/// Angles from the mirror direction out to 180 degrees, for formats whose outgoing directions are relative to it: steps grow from
/// 0.5, 0.25 and 0.1 degrees by a constant ratio.
std::vector<double> radial_grid_deg(GridSize size);

}  // namespace gonio::tabulated
