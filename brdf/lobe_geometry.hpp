// SPDX-License-Identifier: BSD-3-Clause
// The geometry of one sample as the lobe models need it, always in double and never inside automatic differentiation.
#pragma once

#include <limits>

#include "brdf/coordinates.hpp"

namespace gonio {

/// What the lobe models need of a pair of directions, all of it unchanged to the last bit when wi and wo are exchanged (cos_i and cos_o
/// change places). Logarithms of cosines, because cos^s is exp(s · log cos): exact near the peak for every s, and its derivative in s is
/// finite everywhere. `no_lobe` marks a cosine <= 0: the lobe is 0, at s = 0 too.
struct LobeGeometry {
  static constexpr double no_lobe = -std::numeric_limits<double>::infinity();

  double cos_i = 1, cos_o = 1;          ///< cosines of the zenith angles; <= 0 below the horizon
  double log_cos_h = 0;                 ///< ln cos theta_h, half vector against the normal
  double tan2_h = 0;                    ///< tan² theta_h to the last digit; 0 where log_cos_h is no_lobe
  double log_cos_psi = 0;               ///< ln cos psi, outgoing direction against the mirror direction of wi
  double log_cos_retro = 0;             ///< ln cos of the angle between wi and wo
  double cos_d = 1;                     ///< cos theta_d: wi, or wo, against the half vector
  double slope_x = 0, slope_y = 0;      ///< tan theta_h cos phi_h and tan theta_h sin phi_h; 0 where log_cos_h is no_lobe
  double product_x = 0, product_y = 0;  ///< wi.x wo.x and wi.y wo.y
  double beta_gap = 0;                  ///< |β - β0|: wo against the mirrored wi, both projected on the surface; also |wi + wo| there

  bool above_horizon() const noexcept { return cos_i > 0 && cos_o > 0; }
  bool has_half_vector() const noexcept { return log_cos_h > no_lobe; }  ///< it is above the surface
};

/// From angles: ln cos theta_h = -1/2 ln(1 + t²) with t = tan theta_h in product form, ln cos psi = ln(1 - 2q) with
/// q = sin²(psi/2) = sin²((ti-to)/2) + sin ti sin to sin²((dphi-180°)/2); keeps every digit for grazing and nearly mirrored pairs.
LobeGeometry lobe_geometry(const GonioAngles& angles) noexcept;
/// From vectors: t² = (hx²+hy²)/hz² of the unnormalised half vector; sin²(psi/2) = |o-r|²/4 with r the mirrored wi.
LobeGeometry lobe_geometry(const Direction& wi, const Direction& wo) noexcept;

}  // namespace gonio
