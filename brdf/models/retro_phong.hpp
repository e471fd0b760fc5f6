// SPDX-License-Identifier: BSD-3-Clause
// A cosine lobe about the direction of the light.
#pragma once

#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"
#include "brdf/phong_albedo.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)/(2π) cos^s χ with χ the angle between ωi and ωo; 0 for χ >= 90°, at s = 0 too. `phong` with the mirror direction
/// replaced by the light's: the albedo is the same. Energy: ρd + ρs <= 1, exactly.
/// Trap: what a goniometer sees within its blocked cone about the light is missing from its data.
struct RetroPhong {
  static constexpr std::string_view name = "retro-phong";
  static constexpr std::string_view citation =
      "E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg, Non-Linear Approximation of Reflectance Functions, SIGGRAPH 1997 "
      "(retro-reflecting lobes); normalised as the Phong lobe";
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false, 1e-3, 1e9, Parameter::Axis::logarithmic, 40}}};
  static constexpr PeakName peak{"rho_s (s+2)", "1", 2 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    out[0] = T(1 / std::numbers::pi);
    out[1] = phong_norm(nonlinear[0]) * cosine_power(g.log_cos_retro, nonlinear[0]);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = phong_albedo(nonlinear[0], theta);
  }
  static void albedo_bound(const double*, double* out) { out[0] = out[1] = 1; }
};

}  // namespace gonio
