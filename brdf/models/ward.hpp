// SPDX-License-Identifier: BSD-3-Clause
// Ward's Gaussian lobe, isotropic.
#pragma once

#include "brdf/models/ward_terms.hpp"

namespace gonio {

/// f = ρd/π + ρs/(4π α² √(cos θi cos θo)) e^{-tan²θh/α²} (Eq. 4 with α = √2 times the root mean square slope).
/// Traps: ρs is the albedo of the lobe for small α near the normal only; at grazing the albedo first falls and then grows without bound,
/// and f with it: cos θi cos θo counts as at least 1e-8. `ward-duer-gm` has neither fault.
struct Ward {
  static constexpr std::string_view name = "ward";
  static constexpr std::string_view citation = "G. J. Ward, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 1992";
  static constexpr auto parameters = table(one_lobe_parameters, std::array{ward_width("alpha", 0.15)});
  static constexpr PeakName peak{"rho_s/alpha^2", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true, false};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    one_lobe_basis(g.has_half_vector() ? ward_gaussian(g, nonlinear[0]) * static_cast<Plain<T>>(ward_factor(g)) : T(0), out);
  }
};

}  // namespace gonio
