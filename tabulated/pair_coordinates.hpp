// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of a pair of directions in which what a model leaves over of a BRDF is smooth.
#pragma once

#include <array>

#include "brdf/direction.hpp"

namespace gonio::tabulated {

/// (s_x, s_y, t_x, t_y) with s = e(wi) + e(wo), which vanishes at the mirror direction, and t = e(wi).
///
/// e is the azimuthal equal-area projection of J. H. Lambert (1772), e(w) = (w_x, w_y) sqrt(2/(1 + |w_z|)), of length 2 sin(theta/2):
/// unlike the plain projection (w_x, w_y) it keeps steps in elevation apart up to grazing. A lobe about the mirror direction stays at the
/// same s when the incidence changes, so neighbours at other incidences are those in the same place of the lobe.
using PairPoint = std::array<double, 4>;

/// For isotropic data the pair is first turned to phi_i = 0, so t_y = 0; at normal incidence to phi_o = 0.
PairPoint pair_point(const Direction& wi, const Direction& wo, bool isotropic) noexcept;

inline double squared_distance(const PairPoint& a, const PairPoint& b) noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace gonio::tabulated
