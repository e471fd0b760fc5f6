// SPDX-License-Identifier: BSD-3-Clause
// The GGX microfacet surface with separable shadowing and Schlick's Fresnel reflectance.
#pragma once

#include "brdf/models/ggx_terms.hpp"

namespace gonio {

/// As `ggx`, with G = G1(θi) G1(θo): masking and shadowing taken as independent, which is darker at grazing.
struct GgxSeparable {
  static constexpr std::string_view name = "ggx-separable";
  static constexpr std::string_view citation =
      "B. Walter, S. R. Marschner, H. Li, K. E. Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; C. Schlick, "
      "An "
      "Inexpensive BRDF Model for Physically-Based Rendering, CGF 13(3), 1994";
  static constexpr auto parameters = table(schlick_parameters, ggx_roughness);
  static constexpr PeakName peak{"f0/alpha^2", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  /// The lobe [1/sr] from numbers alone, for batches in float (fitting/facet_table.hpp).
  static float lobe(float tan2_h, float cos_i, float cos_o, float alpha) {
    return ggx_distribution(tan2_h, alpha) * ggx_separable_visibility(cos_i, cos_o, alpha);
  }
  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    schlick_basis(g, ggx_separable_lobe(g, nonlinear[0]), out);
  }
};

}  // namespace gonio
