// SPDX-License-Identifier: BSD-3-Clause
// Where pairs of directions lie in a table of the RGL database, many pairs at a time.
#pragma once

#include <array>
#include <cstddef>

#include "tabulated/square_cells.hpp"

namespace gonio::tabulated {

/// Pairs that are looked up together, coordinate by coordinate.
struct RglPairs {
  static constexpr std::size_t most = square_batch;
  using Numbers = SquareColumn;

  std::size_t count = 0;
  Numbers ix, iy, iz, ox, oy, oz;  ///< unit vectors above the horizon

  Numbers theta_i;  ///< radians
  Numbers turn_i;   ///< azimuth of wi in whole turns, from -1/2 to 1/2
  /// On the unit square: x = sqrt(2 theta / pi), y the azimuth in whole turns plus 1/2, in [0, 1).
  Numbers incident_x, incident_y, half_x, half_y;
};

/// Fills the coordinates from the directions. With `relative` the azimuth of the half vector counts from that of wi. Polynomials of
/// arc sine and arc tangent instead of library calls, so that loops run in vectors: errors below 1e-12 of a turn, and the same bits on
/// every instruction set and for every place in the batch.
void find_coordinates(RglPairs& pairs, bool relative);

}  // namespace gonio::tabulated
