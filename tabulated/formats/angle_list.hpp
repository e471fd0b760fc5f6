// SPDX-License-Identifier: BSD-3-Clause
// Where an angle lies in the list of angles of a table.
#pragma once

#include <cstddef>
#include <span>

namespace gonio::tabulated {

/// Neighbours in an increasing list and the weight of the upper one.
struct Bracket {
  std::size_t low = 0, high = 0;
  double weight = 0;   ///< of `high`; `low` has 1 - weight
  bool known = false;  ///< false if the angle lies outside the list
};

/// A list of one angle knows that angle only; 1e-9 of the list's unit beyond an end counts as the end (rounding of radians).
Bracket bracket(std::span<const double> list, double value) noexcept;

/// The same for azimuths in degrees, with the gap between the last one and the first of the next turn bridged if it is no wider than twice
/// the widest other gap. A list of one azimuth holds everywhere.
Bracket bracket_azimuth(std::span<const double> list_deg, double azimuth_deg) noexcept;

}  // namespace gonio::tabulated
