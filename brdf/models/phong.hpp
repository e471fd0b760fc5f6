// SPDX-License-Identifier: BSD-3-Clause
// The normalised Phong lobe.
#pragma once

#include <array>
#include <numbers>

#include "brdf/model.hpp"
#include "brdf/phong_albedo.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)/(2π) cos^s ψ with ψ the angle between wo and the mirror direction of wi; 0 for ψ >= 90°, at s = 0 too.
/// (s+2)/(2π) is exact at normal incidence only; the albedo falls towards grazing. Energy: ρd + ρs <= 1, exactly.
struct Phong {
  static constexpr std::string_view name = "phong";
  static constexpr std::string_view citation =
      "E. P. Lafortune, Y. D. Willems, Using the Modified Phong Reflectance Model for Physically Based Rendering, report CW197, 1994";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false}}};
  static constexpr DependsOn depends_on = DependsOn::psi;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    const T& s = nonlinear[0];
    out[0] = T(1 / std::numbers::pi);
    out[1] = (s + 2.0) * (0.5 / std::numbers::pi) * cosine_power(g.log_cos_psi, s);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = phong_albedo(nonlinear[0], theta);
  }
  static void albedo_bound(const double*, double* out) { out[0] = out[1] = 1; }
};

}  // namespace gonio
