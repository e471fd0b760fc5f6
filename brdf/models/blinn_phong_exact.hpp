// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe, normalised exactly at normal incidence.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)(s+4)/(8π(2^{-s/2}+s)) cos^s θh. Energy: ρd + ρs <= 1.
struct BlinnPhongExact {
  static constexpr std::string_view name = "blinn-phong-exact";
  static constexpr std::string_view citation =
      "J. F. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; normalisation F. Giesen, Phong "
      "Normalization Factor Derivation, 2009";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false}}};
  static constexpr DependsOn depends_on = DependsOn::theta_h;
  static constexpr ModelProperties properties{true, true, true};

  /// 2^(-s/2), in any scalar type.
  template <class T>
  static T exp2_of_minus_half(const T& s) {
    using std::exp;
    return exp(s * (-0.5 * std::numbers::ln2));
  }

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    const T& s = nonlinear[0];
    out[0] = T(1 / std::numbers::pi);
    out[1] = (s + 2.0) / (s + exp2_of_minus_half(s)) * ((s + 4.0) * (0.125 / std::numbers::pi)) * cosine_power(g.log_cos_h, s);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = blinn_phong_exact_norm(nonlinear[0]) * half_vector_lobe_integral(nonlinear[0], theta);
  }
  static void albedo_bound(const double*, double* out) { out[0] = out[1] = 1; }
};

}  // namespace gonio
