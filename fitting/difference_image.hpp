// SPDX-License-Identifier: BSD-3-Clause
// The difference of two BRDFs as a picture: one disc of outgoing directions per incidence.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fitting/compared_values.hpp"

namespace gonio::fitting {

/// Discs side by side. The radius of a disc is theta_o (edge: 90°), its angle phi_o - phi_i: the light lies to the left (phi_o = phi_i),
/// the mirror direction to the right, phi_o - phi_i = 90° at the bottom.
struct DifferenceImage {
  struct Disc {
    double theta_i_deg = 0, phi_i_deg = 0;
  };
  std::vector<Disc> discs;
  std::size_t size = 0;                         ///< rows, and columns of one disc
  std::vector<std::vector<float>> differences;  ///< [channel][row · width + column] relative_difference, NaN where nothing is known
  std::vector<float> mean;                      ///< that of the means over the channels

  std::size_t width() const noexcept { return discs.size() * size; }
};

/// theta_o and phi_o - phi_i of a pixel of a disc; none outside.
struct DiscDirection {
  Angle theta_o, turn;
};
std::optional<DiscDirection> disc_direction(std::size_t row, std::size_t column, std::size_t size) noexcept;

/// Under quadrature both sides are evaluated at every pixel, at incidences 5°, 30°, 45°, 60° and 75° (those within the limit of the
/// comparison) in the plane phi_i = 0. Otherwise a pixel shows the nearest sample of its incidence, if there is one within 7.5°, for the
/// six incidences with most samples.
DifferenceImage difference_image(const CompareSubject& a, const CompareSubject& b, const ComparedValues& values, std::size_t size);

}  // namespace gonio::fitting
