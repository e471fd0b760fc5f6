// SPDX-License-Identifier: BSD-3-Clause
// The grid of MERL's BRDF files in half/difference coordinates: 90 x 90 x 180 cells.
#pragma once

#include <cstddef>

#include "brdf/coordinates.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Matusik et al., "A Data-Driven Reflectance Model", SIGGRAPH 2003, as its files are laid out:
///   theta_h cell h: (h/90)² 90° to ((h+1)/90)² 90°, fine near the highlight; theta_d cell d: d° to (d+1)°;
///   phi_d cell p: p° to (p+1)°, 180 cells: phi_d + 180° is the reciprocal pair and is not stored.
/// Index of a cell: p + 180 (d + 90 h).
struct MerlCell {
  std::size_t theta_h = 0, theta_d = 0, phi_d = 0;
  friend bool operator==(const MerlCell&, const MerlCell&) = default;
};

struct MerlGrid {
  static constexpr std::size_t theta_h_count = 90, theta_d_count = 90, phi_d_count = 180;
  static constexpr std::size_t row_count = theta_d_count * phi_d_count;  ///< cells of one theta_h: 16 200
  static constexpr std::size_t cell_count = theta_h_count * row_count;   ///< 1 458 000

  static constexpr std::size_t index(const MerlCell& cell) noexcept {
    return cell.phi_d + phi_d_count * (cell.theta_d + theta_d_count * cell.theta_h);
  }
  static constexpr MerlCell cell(std::size_t index) noexcept {
    return {index / row_count, index / phi_d_count % theta_d_count, index % phi_d_count};
  }
  /// The cell a pair lies in.
  static MerlCell cell_of(const HalfDifference& coordinates) noexcept;
  /// Where the value of a cell is meant to hold. Files do not say whether this is the cell's left edge (libbsdf interpolates so) or
  /// its centre (fits readers that truncate); reading with the other rule moves a fitted exponent by 5 to 19 %.
  static HalfDifference node(const MerlCell& cell, MerlNodes nodes) noexcept;

  /// Position of a pair in units of cells, measured from the nodes: an integer exactly at a node. Within a millionth of one it
  /// *is* that integer, because the rounding of theta_h near 0 grows through the square root to 1e-7 of a cell.
  struct Position {
    double theta_h, theta_d, phi_d;
  };
  static Position position(const HalfDifference& coordinates, MerlNodes nodes) noexcept;
};

/// True if both directions are above the horizon by more than rounding (1e-15 of the cosine): a node on the horizon is below it on
/// every machine.
bool above_horizon(const DirectionPair& pair) noexcept;

}  // namespace gonio::tabulated
