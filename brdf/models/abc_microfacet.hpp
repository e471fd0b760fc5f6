// SPDX-License-Identifier: BSD-3-Clause
// The microfacet ABC model of Low et al.
#pragma once

#include "brdf/models/abc_terms.hpp"
#include "brdf/models/beckmann_terms.hpp"

namespace gonio {

/// f = ρd/π + A F(θd; n) G/(cos θi cos θo (1 + B (1 - cos θh))^C) (Eq. 15), G the shadowing of V-shaped grooves, F the exact Fresnel
/// reflectance. A in 1/sr is not normalised.
/// Trap: the published tables of A hold for this divided by π: enter A/π. Where both directions lie in the surface the lobe is 0 here.
struct AbcMicrofacet {
  static constexpr std::string_view name = "abc-microfacet";
  static constexpr std::string_view citation =
      "J. Low, J. Kronander, A. Ynnerman, J. Unger, BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces, TOG 31(1), 2012";
  static constexpr auto parameters = table(abc_linear_parameters, abc_nonlinear_parameters);
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    T lobe = T(0);
    if (g.has_half_vector())
      lobe = abc_falloff(-std::expm1(g.log_cos_h), nonlinear) * static_cast<Real>(4 * v_groove_visibility(g)) *
             dielectric_fresnel(static_cast<Real>(g.cos_d), nonlinear[2]);
    one_lobe_basis(lobe, out);
  }
};

}  // namespace gonio
