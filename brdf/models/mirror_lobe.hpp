// SPDX-License-Identifier: BSD-3-Clause
// What the models with a cosine lobe about the mirror direction share.
#pragma once

#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"
#include "brdf/phong_albedo.hpp"

namespace gonio {

/// f = ρd/π + ρs norm(s) cos^s ψ with ψ the angle between wo and the mirror direction of wi; 0 for ψ >= 90°, at s = 0 too. A model adds
/// its `norm` and the unit of its ρs. The albedo of the lobe is largest at the normal: norm(s) over (s+2)/(2π).
template <class Model>
struct MirrorLobe {
  static constexpr std::array<Parameter, 3> parameters_with(std::string_view rho_s_unit) {
    return {{{"rho_d", "1", 0, 1e6, true},
             {"rho_s", rho_s_unit, 0, 1e6, true},
             {"s", "1", 0, 1e9, false, 1e-3, 1e9, Parameter::Axis::logarithmic, 40}}};
  }
  static constexpr DependsOn depends_on = DependsOn::psi;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    out[0] = T(1 / std::numbers::pi);
    out[1] = Model::norm(nonlinear[0]) * cosine_power(g.log_cos_psi, nonlinear[0]);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = Model::norm(nonlinear[0]) / phong_norm(nonlinear[0]) * phong_albedo(nonlinear[0], theta);
  }
  static void albedo_bound(const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = Model::norm(nonlinear[0]) / phong_norm(nonlinear[0]);
  }
};

}  // namespace gonio
