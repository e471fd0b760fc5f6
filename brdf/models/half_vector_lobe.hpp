// SPDX-License-Identifier: BSD-3-Clause
// What the models with a half-vector cosine lobe share.
#pragma once

#include <array>
#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// f = ρd/π + ρs norm(s) cos^s θh with θh between the half vector and the normal; a model adds its `norm`.
/// The albedo of the lobe is largest at the normal: norm(s) over the exact normalisation.
template <class Model>
struct HalfVectorLobe {
  static constexpr std::array<Parameter, 3> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"rho_s", "1", 0, 1e6, true}, {"s", "1", 0, 1e9, false, 1e-3, 1e9, Parameter::Axis::logarithmic, 40}}};
  static constexpr DependsOn depends_on = DependsOn::theta_h;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    out[0] = T(1 / std::numbers::pi);
    out[1] = Model::norm(nonlinear[0]) * cosine_power(g.log_cos_h, nonlinear[0]);
  }
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = Model::norm(nonlinear[0]) * half_vector_lobe_integral(nonlinear[0], theta);
  }
  static void albedo_bound(const double* nonlinear, double* out) {
    out[0] = 1;
    out[1] = Model::norm(nonlinear[0]) / blinn_phong_exact_norm(nonlinear[0]);
  }
};

}  // namespace gonio
