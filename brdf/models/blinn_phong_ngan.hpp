// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe as Ngan et al. fitted it.
#pragma once

#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)/(2π) cos^s θh: the constant normalises the distribution of half vectors, not the BRDF, so the albedo of
/// the lobe at the normal is 4(2^{-s/2}+s)/(s+4), up to 4. Energy: ρd + ρs 4(2^{-s/2}+s)/(s+4) <= 1.
struct BlinnPhongNgan {
  static constexpr std::string_view name = "blinn-phong-ngan";
  static constexpr std::string_view citation = "A. Ngan, F. Durand, W. Matusik, Experimental Analysis of BRDF Models, EGSR 2005";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false}}};
  static constexpr DependsOn depends_on = DependsOn::theta_h;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    const T& s = nonlinear[0];
    out[0] = T(1 / std::numbers::pi);
    out[1] = (s + 2.0) * (0.5 / std::numbers::pi) * cosine_power(g.log_cos_h, s);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = phong_norm(nonlinear[0]) * half_vector_lobe_integral(nonlinear[0], theta);
  }
  static void albedo_bound(const double* nonlinear, double* out) {
    const double s = nonlinear[0];
    out[0] = 1;
    out[1] = phong_norm(s) / blinn_phong_exact_norm(s);
  }
};

}  // namespace gonio
