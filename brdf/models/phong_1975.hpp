// SPDX-License-Identifier: BSD-3-Clause
// Phong's lobe without normalisation.
#pragma once

#include <array>
#include <numbers>

#include "brdf/model.hpp"
#include "brdf/phong_albedo.hpp"

namespace gonio {

/// f = ρd/π + ρs cos^s ψ with ψ the angle between wo and the mirror direction of wi; 0 for ψ >= 90°. ρs is in 1/sr here.
/// This is the reciprocal reading as a BRDF: the 1975 shading formula divided by cos θi is neither reciprocal nor bounded.
/// Energy: ρd + 2π ρs/(s+2) <= 1.
struct Phong1975 {
  static constexpr std::string_view name = "phong-1975";
  static constexpr std::string_view citation = "B. T. Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1/sr", 0, 1e6, true}, {"s", "1", 0, 1e9, false}}};
  static constexpr DependsOn depends_on = DependsOn::psi;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    const T& s = nonlinear[0];
    out[0] = T(1 / std::numbers::pi);
    out[1] = cosine_power(g.log_cos_psi, s);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = 2 * std::numbers::pi / (nonlinear[0] + 2) * phong_albedo(nonlinear[0], theta);
  }
  static void albedo_bound(const double* nonlinear, double* out) {
    const double s = nonlinear[0];
    out[0] = 1;
    out[1] = 2 * std::numbers::pi / (s + 2);
  }
};

}  // namespace gonio
