// SPDX-License-Identifier: BSD-3-Clause
// Ashikhmin and Shirley's Phong-like lobe with two exponents.
#pragma once

#include "brdf/models/ashikhmin_shirley_terms.hpp"

namespace gonio {

/// f = ρd/π + √((nu + 1)(nv + 1))/(8π) cos^{nu cos²φh + nv sin²φh} θh / (cos θd max(cos θi, cos θo)) (F0 (1 - w) + F90 w), the axes
/// u and v along x and y of the sample. A larger exponent is a narrower lobe. Otherwise as `ashikhmin-shirley`.
struct AshikhminShirleyAnisotropic {
  static constexpr std::string_view name = "ashikhmin-shirley-anisotropic";
  static constexpr std::string_view citation = "M. Ashikhmin, P. Shirley, An Anisotropic Phong BRDF Model, JGT 5(2), 2000";
  static constexpr auto parameters = table(schlick_parameters, std::array{ashikhmin_exponent("nu", 200), ashikhmin_exponent("nv", 30)});
  static constexpr PeakName peak{"f0 sqrt((nu+1)(nv+1))", "1", 8 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, false, false};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using std::sqrt;
    using Real = Plain<T>;
    T lobe = T(0);
    if (g.has_half_vector()) {
      const double x2 = g.slope_x * g.slope_x, y2 = g.slope_y * g.slope_y, sum = x2 + y2;
      const double along_u = sum > 0 ? x2 / sum : 0.5;  // at the peak the lobe does not depend on it
      const T exponent =
          nonlinear[0] * static_cast<Real>(-g.log_cos_h * along_u) + nonlinear[1] * static_cast<Real>(-g.log_cos_h * (1 - along_u));
      lobe = decay<T>(exponent) * sqrt((nonlinear[0] + Real(1)) * (nonlinear[1] + Real(1))) * static_cast<Real>(ashikhmin_factor(g));
    }
    schlick_basis(g, lobe, out);
  }
};

}  // namespace gonio
