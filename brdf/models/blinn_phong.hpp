// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe with the customary normalisation.
#pragma once

#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+8)/(8π) cos^s θh with θh between the half vector and the normal.
/// The normalisation over-reflects: the albedo of the lobe at the normal is A(0;s) = (s+8)(2^{-s/2}+s)/((s+2)(s+4)), up to 1.0752.
/// Energy: ρd + ρs A(0;s) <= 1.
struct BlinnPhong {
  static constexpr std::string_view name = "blinn-phong";
  static constexpr std::string_view citation =
      "J. F. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; (s+8)/(8 pi) as in T. Akenine-Moeller, E. "
      "Haines, N. Hoffman, Real-Time Rendering, 3rd ed., 2008";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false}}};
  static constexpr DependsOn depends_on = DependsOn::theta_h;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    const T& s = nonlinear[0];
    out[0] = T(1 / std::numbers::pi);
    out[1] = (s + 8.0) * (0.125 / std::numbers::pi) * cosine_power(g.log_cos_h, s);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = blinn_phong_norm(nonlinear[0]) * half_vector_lobe_integral(nonlinear[0], theta);
  }
  static void albedo_bound(const double* nonlinear, double* out) {
    const double s = nonlinear[0];
    out[0] = 1;
    out[1] = blinn_phong_norm(s) / blinn_phong_exact_norm(s);
  }
};

}  // namespace gonio
