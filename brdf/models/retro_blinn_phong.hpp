// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe of retro-reflectors.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)(s+4)/(8π(2^{-s/2}+s)) cos^s θb with θb between the normal and the back vector, the half vector of ωo and the
/// mirrored ωi: `blinn-phong-exact` with the light on the other side, so that the lobe peaks where ωo = ωi. Energy: ρd + ρs <= 1.
/// Trap: as for `retro-phong`; a real corner-cube tape has a lobe that no cosine follows.
struct RetroBlinnPhong {
  static constexpr std::string_view name = "retro-blinn-phong";
  static constexpr std::string_view citation =
      "L. Belcour, R. Pacanowski, M. Delahaie, A. Laville-Geay, L. Eupherte, BRDF Measurements and Analysis of Retroreflective Materials, "
      "JOSA A 31(12), 2014; normalisation F. Giesen, Phong Normalization Factor Derivation, 2009";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false, 1e-3, 1e9, Parameter::Axis::logarithmic, 40}}};
  static constexpr PeakName peak{"rho_s (s+2)(s+4)/(s+2^(-s/2))", "1", 8 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    out[0] = T(1 / std::numbers::pi);
    out[1] = blinn_phong_exact_norm(nonlinear[0]) * cosine_power(log_cos_back(g), nonlinear[0]);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = blinn_phong_exact_norm(nonlinear[0]) * half_vector_lobe_integral(nonlinear[0], theta);
  }
  static void albedo_bound(const double*, double* out) { out[0] = out[1] = 1; }

 private:
  /// ln cos θb: tan²θb = |ωi - ωo|²_xy/(cos θi + cos θo)², with |ωi - ωo|² = 2 (1 - cos χ), χ the angle between them.
  static double log_cos_back(const LobeGeometry& g) {
    const double hz = g.cos_i + g.cos_o, dz = g.cos_i - g.cos_o;
    if (!(hz > 0)) return LobeGeometry::no_lobe;
    const bool near = g.log_cos_retro > LobeGeometry::no_lobe;
    const double one_minus_cos = near ? -std::expm1(g.log_cos_retro) : 1 - (g.cos_i * g.cos_o + (g.product_x + g.product_y));
    return -0.5 * std::log1p(std::max(0.0, 2 * one_minus_cos - dz * dz) / (hz * hz));
  }
};

}  // namespace gonio
