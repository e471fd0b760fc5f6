// SPDX-License-Identifier: BSD-3-Clause
// One lobe of the generalised cosine model of Lafortune et al.
#pragma once

#include <numbers>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/models/microfacet.hpp"
#include "brdf/phong_albedo.hpp"

namespace gonio {

/// f = ρd/π + ρs 2 d^n/(|Cxy|^n + Cz^n), d = max(0, Cxy (xi xo + yi yo) + Cz zi zo), (-Cxy, Cz) = (cos δ, sin δ).
/// Only the ratio of Cxy and Cz is a shape, their length a factor of the amplitude: published values turn into
///   δ = atan2(Cz, -Cxy),  ρs = amplitude · (|Cxy|^n + Cz^n)/2.
/// So ρs [1/sr] is the mean of the two extreme peaks of the lobe, at the normal and at grazing. δ = 45° is `phong-1975` with s = n, δ > 45°
/// a lobe lifted towards the normal, δ = 90° one about the normal (cos θi cos θo)^n, δ = 135° one about the light. Several lobes as sums:
/// `lafortune+lafortune`. Cz > 0 only.
/// Trap: off-specular lobes (δ far from 45°) with a large n have one peak much higher than the other.
struct Lafortune {
  static constexpr std::string_view name = "lafortune";
  static constexpr std::string_view citation =
      "E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg, Non-Linear Approximation of Reflectance Functions, SIGGRAPH 1997";
  static constexpr std::array<Parameter, 4> parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.2},
                                                        {"rho_s", "1/sr", 0, 1e6, true},
                                                        {"n", "1", 1, 1e9, false, 1, 1e6, Parameter::Axis::logarithmic, 20},
                                                        {"delta_deg", "deg", 1, 179, false, 20, 160, Parameter::Axis::linear, 48}}};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using std::log;
    using Real = Plain<T>;
    const auto [minus_xy, z] = direction(nonlinear[1]);
    const T d = minus_xy * static_cast<Real>(-(g.product_x + g.product_y)) + z * static_cast<Real>(g.cos_i * g.cos_o);
    one_lobe_basis(d > Real(0) ? decay<T>(log_peaks(minus_xy, z, nonlinear[0]) - nonlinear[0] * log(d)) : T(0), out);
  }
  /// The lobe is v^n cos^n of the angle to the direction v = (Cxy xi, Cxy yi, Cz zi), whose integral is Phong's at the zenith angle of v.
  static void albedo(Angle theta, const double* nonlinear, double* out) {
    const auto [minus_xy, z] = direction(nonlinear[1]);
    const double across = std::abs(minus_xy) * theta.sin(), up = z * theta.cos(), n = nonlinear[0];
    const double length = std::hypot(across, up);
    out[0] = 1;
    out[1] =
        length > 0 ? decay(log_peaks(minus_xy, z, n) - n * std::log(length)) * phong_albedo(n, angle_of(across, up)) / phong_norm(n) : 0;
  }

 private:
  template <class T>
  static std::array<T, 2> direction(const T& delta_deg) {
    using std::cos;
    using std::sin;
    const T delta = delta_deg * static_cast<Plain<T>>(std::numbers::pi / 180);
    return {cos(delta), sin(delta)};
  }
  /// ln((|a|^n + b^n)/2), smooth in both: the logarithm of the larger power plus what the smaller one adds.
  template <class T>
  static T log_peaks(const T& a, const T& b, const T& n) {
    using std::log;
    using std::log1p;
    using Real = Plain<T>;
    const T log_a2 = log(a * a + Real(1e-30)), log_b2 = log(b * b);  // 90° itself has no Cxy
    const T larger = log_a2 > log_b2 ? log_a2 : log_b2, smaller = log_a2 > log_b2 ? log_b2 : log_a2;
    return Real(0.5) * n * larger + log1p(decay<T>(Real(0.5) * n * (larger - smaller))) - Real(std::numbers::ln2);
  }
};

}  // namespace gonio
