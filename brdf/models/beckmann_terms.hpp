// SPDX-License-Identifier: BSD-3-Clause
// Beckmann's distribution of slopes and the shadowing of V-shaped grooves.
#pragma once

#include <algorithm>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// D(h) = e^{-tan²θh/m²} / (π m² cos⁴θh), m = √2 times the root mean square slope
/// (P. Beckmann, A. Spizzichino, The Scattering of Electromagnetic Waves from Rough Surfaces, 1963).
template <class T>
T beckmann_distribution(Plain<T> tan2_h, const T& m) {
  using Real = Plain<T>;
  const T m2 = m * m, gaussian = decay<T>(tan2_h / m2);
  if (!(gaussian > Real(0))) return T(0);  // (1 + t)² may overflow where the exponential has long vanished
  return static_cast<Real>(1 / std::numbers::pi) * gaussian * ((1 + tan2_h) * (1 + tan2_h)) / m2;
}

/// G/(4 cos θi cos θo) of V-shaped grooves, G = min(1, 2 cos θh min(cos θi, cos θo)/cos θd)
/// (K. E. Torrance, E. M. Sparrow, Theory for Off-Specular Reflection from Roughened Surfaces, JOSA 57(9), 1967).
/// With cos θh = (ci + co)/(2 cos θd) the smaller cosine cancels where it could vanish.
inline double v_groove_visibility(const LobeGeometry& g) {
  const double least = std::min(g.cos_i, g.cos_o), most = std::max(g.cos_i, g.cos_o), cos2_d = g.cos_d * g.cos_d;
  const double sum = g.cos_i + g.cos_o;
  return sum * least < cos2_d ? sum / (4 * cos2_d * most) : 1 / (4 * (g.cos_i * g.cos_o));
}

}  // namespace gonio
