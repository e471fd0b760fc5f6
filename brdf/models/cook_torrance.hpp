// SPDX-License-Identifier: BSD-3-Clause
// The microfacet surface of Cook and Torrance.
#pragma once

#include "brdf/models/beckmann_terms.hpp"

namespace gonio {

/// f = ρd/π + D G/(4 cos θi cos θo) (F0 (1 - w) + F90 w), w = (1 - cos θd)^5, with Beckmann's D and the shadowing of V-shaped grooves.
/// Traps: the paper (and the fits of Ngan 2005 and Low 2012) divides by π where energy asks for 4, and counts D without its 1/π: its
/// F is a quarter of ours. Where both directions lie in the surface the lobe has no limit and is 0 here.
struct CookTorrance {
  static constexpr std::string_view name = "cook-torrance";
  static constexpr std::string_view citation =
      "R. L. Cook, K. E. Torrance, A Reflectance Model for Computer Graphics, TOG 1(1), 1982; C. Schlick, An Inexpensive BRDF Model for "
      "Physically-Based Rendering, CGF 13(3), 1994";
  static constexpr auto parameters =
      table(schlick_parameters, std::array<Parameter, 1>{{{"m", "1", 1e-4, 10, false, 1e-3, 2, Parameter::Axis::logarithmic, 0.15}}});
  static constexpr PeakName peak{"f0/m^2", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    const T lobe = g.has_half_vector()
                       ? beckmann_distribution(static_cast<Real>(g.tan2_h), nonlinear[0]) * static_cast<Real>(v_groove_visibility(g))
                       : T(0);
    schlick_basis(g, lobe, out);
  }
};

}  // namespace gonio
