// SPDX-License-Identifier: BSD-3-Clause
// The GGX microfacet surface with height-correlated shadowing and Schlick's Fresnel reflectance.
#pragma once

#include "brdf/models/ggx_terms.hpp"

namespace gonio {

/// f = ρd/π + D(θh) G/(4 cos θi cos θo) (F0 (1 - w) + F90 w), w = (1 - cos θd)^5. For given alpha it is linear in ρd, F0 and F90.
/// The lobe with F0 = F90 = 1 reflects at most everything; what several scatterings would add is missing.
/// Trap: alpha² is the usual "roughness" to the fourth. Where both directions lie in the surface the lobe has no limit and is 0 here.
struct Ggx {
  static constexpr std::string_view name = "ggx";
  static constexpr std::string_view citation =
      "B. Walter, S. R. Marschner, H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; E. Heitz, "
      "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014; C. Schlick, An Inexpensive BRDF Model for "
      "Physically-Based Rendering, CGF 13(3), 1994";
  static constexpr auto parameters = table(schlick_parameters, ggx_roughness);
  static constexpr PeakName peak{"f0/alpha^2", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  /// The lobe [1/sr] from numbers alone, for batches in float (fitting/facet_table.hpp).
  static float lobe(float tan2_h, float cos_i, float cos_o, float alpha) {
    return ggx_distribution(tan2_h, alpha) * ggx_visibility(cos_i, cos_o, alpha);
  }
  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    schlick_basis(g, ggx_lobe(g, nonlinear[0]), out);
  }
};

}  // namespace gonio
