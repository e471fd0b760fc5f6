// SPDX-License-Identifier: BSD-3-Clause
// Ashikhmin and Shirley's Phong-like lobe, isotropic.
#pragma once

#include "brdf/models/ashikhmin_shirley_terms.hpp"

namespace gonio {

/// f = ρd/π + (n + 1)/(8π) cos^n θh / (cos θd max(cos θi, cos θo)) (F0 (1 - w) + F90 w), w = (1 - cos θd)^5 (the paper's with nu = nv = n).
/// Trap: the paper takes F90 = 1 and couples a diffuse part to 1 - F0; here the diffuse part is Lambert's, so that the model
/// stays linear in ρd, F0 and F90.
struct AshikhminShirley {
  static constexpr std::string_view name = "ashikhmin-shirley";
  static constexpr std::string_view citation = "M. Ashikhmin, P. Shirley, An Anisotropic Phong BRDF Model, JGT 5(2), 2000";
  static constexpr auto parameters = table(schlick_parameters, std::array{ashikhmin_exponent("n", 80)});
  static constexpr PeakName peak{"f0 (n+1)", "1", 8 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    T lobe = T(0);
    if (g.has_half_vector())
      lobe = decay<T>(nonlinear[0] * static_cast<Real>(-g.log_cos_h)) * (nonlinear[0] + Real(1)) * static_cast<Real>(ashikhmin_factor(g));
    schlick_basis(g, lobe, out);
  }
};

}  // namespace gonio
