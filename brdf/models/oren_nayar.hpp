// SPDX-License-Identifier: BSD-3-Clause
// The rough diffuse surface of Oren and Nayar.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// f = ρd/π (A + B max(0, cos(φi - φo)) sin α tan β), α the larger and β the smaller zenith angle,
/// A = 1 - σ²/(2 (σ² + 0.33)), B = 0.45 σ²/(σ² + 0.09), σ the standard deviation of the slope angle in radians (Eq. 30, the "qualitative
/// model" without interreflection). σ = 0 is Lambert.
/// sin α tan β = sin θi sin θo / max(cos θi, cos θo); towards retro-reflection at grazing f has no limit: the larger cosine counts as at
/// least 1e-4, 89.994°.
/// As the first term of a sum it replaces Lambert's diffuse part. Trap: the albedo is not ρd but ρd A at the normal and ρd (A + B/2) at
/// grazing.
struct OrenNayar {
  static constexpr std::string_view name = "oren-nayar";
  static constexpr std::string_view citation = "M. Oren, S. K. Nayar, Generalization of Lambert's Reflectance Model, SIGGRAPH 1994";
  static constexpr std::array<Parameter, 2> parameters{
      {{"rho_d", "1", 0, 1e6, true}, {"sigma_deg", "deg", 0, 90, false, 0, 60, Parameter::Axis::linear, 20}}};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    const double along = std::max(0.0, g.product_x + g.product_y) / std::max(least_cosine, std::max(g.cos_i, g.cos_o));
    const T sigma = nonlinear[0] * static_cast<Real>(std::numbers::pi / 180), sigma2 = sigma * sigma;
    out[0] = (constant(sigma2) + slope(sigma2) * static_cast<Real>(along)) * static_cast<Real>(1 / std::numbers::pi);
  }
  /// A + (2B/π) (sin θ (θ - sin θ cos θ)/2 + tan θ (1 - sin³θ)/3), the integral over both sides of θo = θi.
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    const double sigma = nonlinear[0] * std::numbers::pi / 180, s = theta.sin(), c = theta.cos();
    const double grows = s * (theta.radians() - s * c) / 2 + s * c * (1 + s + s * s) / (3 * (1 + s));
    out[0] = constant(sigma * sigma) + slope(sigma * sigma) * 2 / std::numbers::pi * grows;
  }

 private:
  static constexpr double least_cosine = 1e-4;
  template <class T>
  static T constant(const T& sigma2) {
    using Real = Plain<T>;
    return Real(1) - Real(0.5) * sigma2 / (sigma2 + Real(0.33));
  }
  template <class T>
  static T slope(const T& sigma2) {
    using Real = Plain<T>;
    return Real(0.45) * sigma2 / (sigma2 + Real(0.09));
  }
};

}  // namespace gonio
