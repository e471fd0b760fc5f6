// SPDX-License-Identifier: BSD-3-Clause
// The smooth-surface ABC model of Low et al.
#pragma once

#include <algorithm>

#include "brdf/models/abc_terms.hpp"

namespace gonio {

/// f = ρd/π + A F(θd; n)/(1 + B |Dp|²)^C: Dp = β - β0 the outgoing direction against the mirror direction, both projected on the surface
/// (Eq. 10), F the Fresnel reflectance at cos θd = √(1 - |Ip - Op|²/4) of the projected directions (Eqs. 12 to 14). Written in
/// Rayleigh-Rice manner, without shadowing; finite everywhere. A in 1/sr is the peak for F = 1. Traps: cos θd is that of the mirror pair,
/// not of the half vector. Far from the peak only A B^-C is determined.
struct Abc {
  static constexpr std::string_view name = "abc";
  static constexpr std::string_view citation =
      "J. Low, J. Kronander, A. Ynnerman, J. Unger, BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces, TOG 31(1), 2012";
  static constexpr auto parameters = table(abc_linear_parameters, abc_nonlinear_parameters);
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    const double apart2 = ((1 - g.cos_i * g.cos_i) + (1 - g.cos_o * g.cos_o)) - 2 * (g.product_x + g.product_y);
    const double cos_d = std::sqrt(std::clamp(1 - apart2 / 4, 0.0, 1.0));
    one_lobe_basis(abc_falloff(g.beta_gap * g.beta_gap, nonlinear) * dielectric_fresnel(static_cast<Real>(cos_d), nonlinear[2]), out);
  }
};

}  // namespace gonio
