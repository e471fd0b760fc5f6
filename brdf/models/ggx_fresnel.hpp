// SPDX-License-Identifier: BSD-3-Clause
// The GGX microfacet surface of a dielectric, height-correlated shadowing.
#pragma once

#include "brdf/models/ggx_terms.hpp"

namespace gonio {

/// f = ρd/π + ρs D G F(θd; n)/(4 cos θi cos θo) with the exact Fresnel reflectance of a dielectric of index n for unpolarised light.
/// ρs = 1 is a bare dielectric, and ρs F is then a physical reflectance; other values absorb what the model lacks.
/// Trap: away from grazing only ρs ((n - 1)/(n + 1))² is determined.
struct GgxFresnel {
  static constexpr std::string_view name = "ggx-fresnel";
  static constexpr std::string_view citation =
      "B. Walter, S. R. Marschner, H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; E. Heitz, "
      "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014";
  static constexpr auto parameters = table(one_lobe_parameters, std::array{ggx_roughness[0], refractive_index});
  static constexpr PeakName peak{"rho_s ((n-1)/(n+1))^2/alpha^2", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    one_lobe_basis(ggx_lobe(g, nonlinear[0]) * dielectric_fresnel(static_cast<Plain<T>>(g.cos_d), nonlinear[1]), out);
  }
};

}  // namespace gonio
