// SPDX-License-Identifier: BSD-3-Clause
// The shifted gamma distribution with its fitted shadowing and Fresnel terms.
#pragma once

#include <algorithm>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// f = ρd/π + ρs/π² F(θd) P(tan²θh) G1(θi) G1(θo) / (cos⁴θh cos θi cos θo), each colour with parameters of its own, with
///   P(t) = e^{-x} / x^p, x = α + t/α                       the shifted gamma distribution of squared slopes,
///   F(θd) = F0 - F1 cos θd + (1 - F0)(1 - cos θd)^5,       cut at 0 (the published fits become negative for 7 of 300 sets),
///   G1(θ) = 1 + λ (1 - e^{c (θ - θ0)^k}) for θ > θ0, else 1, cut at 0; θ and θ0 in radians.
/// ρs = Ks Kαp of the published tables: the normalisation of the distribution and the specular reflectance cannot be told apart.
/// Traps: the albedo has no bound at grazing, where G1 need not vanish: cos θi cos θo counts as at least 1e-8. λ, c, k and θ0 were fitted
/// to the distribution, not to data, and F1 is a small correction: a fit holds all five unless told otherwise, at the published values of
/// a yellow plastic, where G1 falls to 0 at the horizon.
struct Sgd {
  static constexpr std::string_view name = "sgd";
  static constexpr std::string_view citation =
      "M. M. Bagher, C. Soler, N. Holzschuch, Accurate fitting of measured reflectances using a Shifted Gamma micro-facet distribution, "
      "CGF "
      "31(4), 2012";
  static constexpr auto parameters = table(
      one_lobe_parameters,
      std::array<Parameter, 8>{{{"alpha", "1", 1e-6, 10, false, 1e-4, 1, Parameter::Axis::logarithmic, 0.024},
                                {"p", "1", 0, 10, false, 0, 2, Parameter::Axis::linear, 0.56},
                                {"f0", "1", 0, 20, false, 0, 1, Parameter::Axis::linear, 0.06},
                                {"f1", "1", -20, 20, false, -1, 1, Parameter::Axis::linear, 0.05, true},
                                {"lambda", "1", 1e-9, 1e8, false, 0.1, 10, Parameter::Axis::logarithmic, 2.15, true},
                                {"c", "1", 1e-12, 1e300, false, 1e-8, 10, Parameter::Axis::logarithmic, 6e-8, true},
                                {"k", "1", 1, 1000, false, 5, 500, Parameter::Axis::logarithmic, 41.8, true},
                                {"theta0_rad", "rad", -1, 1.5707963267948966, false, -0.6, 1.2, Parameter::Axis::linear, 0.116, true}}});
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true, false};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using std::log;
    using Real = Plain<T>;
    one_lobe_basis(T(0), out);
    if (!g.has_half_vector()) return;
    const T &alpha = nonlinear[0], &p = nonlinear[1], &f0 = nonlinear[2], &f1 = nonlinear[3];
    const Real tan2 = static_cast<Real>(g.tan2_h), cos_d = static_cast<Real>(g.cos_d), w = schlick_weight(cos_d);
    const T fresnel = f0 * (1 - w) - f1 * cos_d + w;
    if (!(fresnel > Real(0))) return;
    const T x = alpha + tan2 / alpha;
    const T distribution = decay<T>(x + p * log(x));
    const T shadowing = shadow(g.cos_i, nonlinear + 4) * shadow(g.cos_o, nonlinear + 4);
    const double cosines = std::max(g.cos_i * g.cos_o, least_cosine_product);
    // (1 + t)² = 1/cos⁴θh may overflow where e^{-x} has long vanished.
    const Real rest = static_cast<Real>((1 + g.tan2_h) / (std::numbers::pi * cosines)),
               steep = static_cast<Real>((1 + g.tan2_h) / std::numbers::pi);
    out[1] = distribution * rest * steep * fresnel * shadowing;
  }

 private:
  /// G1; `shape` is λ, c, k, θ0.
  template <class T>
  static T shadow(double cosine, const T* shape) {
    using std::exp;
    using std::expm1;
    using std::log;
    using Real = Plain<T>;
    const T above = static_cast<Real>(std::acos(std::clamp(cosine, -1.0, 1.0))) - shape[3];
    if (!(above > Real(0))) return T(1);
    const T log_exponent = log(shape[1]) + shape[2] * log(above);
    if (log_exponent < Real(-80)) return T(1);
    if (log_exponent > Real(4)) return T(0);  // e^55 times the least λ is above 1
    const T value = Real(1) - shape[0] * expm1(exp(log_exponent));
    return value > Real(0) ? value : T(0);
  }
};

}  // namespace gonio
