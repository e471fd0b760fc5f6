// SPDX-License-Identifier: BSD-3-Clause
// Distribution and shadowing of the GGX surface, each in its cheapest form without a division that can fail.
#pragma once

#include <cmath>
#include <numbers>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// Roughness of the GGX models. alpha is the slope scale itself, not its square root as in renderers' "roughness" sliders.
inline constexpr std::array<Parameter, 1> ggx_roughness{{{"alpha", "1", 1e-4, 10, false, 1e-3, 2, Parameter::Axis::logarithmic, 0.15}}};

/// D(h) = α² / (π (cos²θh (α² - 1) + 1)²) = α²/π ((1 + t)/(α² + t))² with t = tan²θh
/// (B. Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, Eq. 33).
template <class T>
T ggx_distribution(Plain<T> tan2_h, const T& alpha) {
  using Real = Plain<T>;
  const T alpha2 = alpha * alpha;
  const T ratio = (1 + tan2_h) / (alpha2 + tan2_h);
  return static_cast<Real>(1 / std::numbers::pi) * alpha2 * ratio * ratio;
}

/// G/(4 cos θi cos θo) for masking and shadowing correlated through the height: 1/(2 (co √(α² si² + ci²) + ci √(α² so² + co²)))
/// (E. Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014, Eq. 99). Finite unless both
/// directions graze.
template <class T>
T ggx_visibility(Plain<T> ci, Plain<T> co, const T& alpha) {
  using std::sqrt;
  using Real = Plain<T>;
  const T alpha2 = alpha * alpha;
  return Real(0.5) / (co * sqrt(alpha2 * (1 - ci * ci) + ci * ci) + ci * sqrt(alpha2 * (1 - co * co) + co * co));
}

/// G/(4 cos θi cos θo) for the product of Smith's terms: 1/((ci + √(α² si² + ci²)) (co + √(α² so² + co²)))
/// (Walter et al. 2007, Eqs. 23 and 34). Finite everywhere.
template <class T>
T ggx_separable_visibility(Plain<T> ci, Plain<T> co, const T& alpha) {
  using std::sqrt;
  using Real = Plain<T>;
  const T alpha2 = alpha * alpha;
  return Real(1) / ((sqrt(alpha2 * (1 - ci * ci) + ci * ci) + ci) * (sqrt(alpha2 * (1 - co * co) + co * co) + co));
}

/// D G/(4 cos θi cos θo) with height-correlated shadowing; 0 where both directions lie in the surface.
template <class T>
T ggx_lobe(const LobeGeometry& g, const T& alpha) {
  using Real = Plain<T>;
  if (!g.has_half_vector()) return T(0);
  return ggx_distribution(static_cast<Real>(g.tan2_h), alpha) *
         ggx_visibility(static_cast<Real>(g.cos_i), static_cast<Real>(g.cos_o), alpha);
}

/// The same with separable shadowing.
template <class T>
T ggx_separable_lobe(const LobeGeometry& g, const T& alpha) {
  using Real = Plain<T>;
  if (!g.has_half_vector()) return T(0);
  return ggx_distribution(static_cast<Real>(g.tan2_h), alpha) *
         ggx_separable_visibility(static_cast<Real>(g.cos_i), static_cast<Real>(g.cos_o), alpha);
}

}  // namespace gonio
