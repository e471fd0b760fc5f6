// SPDX-License-Identifier: BSD-3-Clause
// What the models with a half-vector distribution share: number type, Fresnel terms, linear coefficients of Schlick's approximation.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "brdf/model.hpp"

namespace gonio {

/// The number type of the geometry beside parameters of type T: float with float, double with double and automatic differentiation.
template <class T>
using Plain = std::conditional_t<std::is_same_v<T, float>, float, double>;

/// Cosines of both directions together below this, 1e-8, count as 1e-8: two directions at 89.994°, or one much nearer to the surface.
/// Models that divide by cos θi cos θo have no limit at the horizon; they stay finite and keep a definite value there.
inline constexpr double least_cosine_product = 1e-8;

/// exp(-x), 0 beyond what T still holds as a normal number.
template <class T>
T decay(const T& x) {
  using std::exp;
  if (x > Plain<T>(std::is_same_v<T, float> ? 87 : 700)) return T(0);
  return exp(-x);
}

/// (1 - cos theta_d)^5 of Schlick's approximation to the Fresnel reflectance, F = F0 + (F90 - F0)(1 - cos theta_d)^5
/// (C. Schlick, An Inexpensive BRDF Model for Physically-Based Rendering, CGF 13(3), 1994, Eq. 15).
template <class Real>
constexpr Real schlick_weight(Real cos_d) {
  const Real m = 1 - cos_d, m2 = m * m;
  return m2 * m2 * m;
}

/// Fresnel reflectance of a dielectric of index n for unpolarised light (R. L. Cook, K. E. Torrance, A Reflectance Model for Computer
/// Graphics, TOG 1(1), 1982): with g² = n² - 1 + c²,
/// F = 1/2 ((g - c)/(g + c))² (1 + ((c (g + c) - 1)/(c (g - c) + 1))²). n > 1, so that g > 0 and no denominator vanishes.
template <class T>
T dielectric_fresnel(Plain<T> c, const T& n) {
  using std::sqrt;
  using Real = Plain<T>;
  const T g = sqrt(n * n + (c * c - 1));
  const T sum = g + c, difference = g - c;
  const T perpendicular = difference / sum, ratio = (c * sum - Real(1)) / (c * difference + Real(1));
  return Real(0.5) * perpendicular * perpendicular * (ratio * ratio + Real(1));
}

/// Refractive index of a dielectric. n = 1 has no reflection at all and is left out.
inline constexpr Parameter refractive_index{"n", "1", 1.001, 100, false, 1.05, 10, Parameter::Axis::logarithmic, 1.5};

/// Parameters of f = ρd/π + lobe · (F0 (1 - w) + F90 w) with w = `schlick_weight`: both reflectances are linear. A model adds its own
/// nonlinear ones.
inline constexpr std::array<Parameter, 3> schlick_parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.2},
                                                              {"f0", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.1},
                                                              {"f90", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 1}}};
/// Parameters of f = ρd/π + ρs · lobe. A model adds its own nonlinear ones.
inline constexpr std::array<Parameter, 2> one_lobe_parameters{
    {{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.2}, {"rho_s", "1", 0, 1e6, true}}};

/// The parameter table of linear parameters followed by nonlinear ones.
template <std::size_t L, std::size_t N>
constexpr std::array<Parameter, L + N> table(const std::array<Parameter, L>& linear, const std::array<Parameter, N>& nonlinear) {
  std::array<Parameter, L + N> all{};
  for (std::size_t k = 0; k < L; ++k) all[k] = linear[k];
  for (std::size_t k = 0; k < N; ++k) all[L + k] = nonlinear[k];
  return all;
}

/// The basis that goes with `schlick_parameters`.
template <class T>
void schlick_basis(const LobeGeometry& g, const T& lobe, T* out) {
  using Real = Plain<T>;
  const Real w = schlick_weight(static_cast<Real>(g.cos_d));
  out[0] = T(static_cast<Real>(1 / std::numbers::pi));
  out[1] = lobe * (1 - w);
  out[2] = lobe * w;
}

/// The basis that goes with `one_lobe_parameters`.
template <class T>
void one_lobe_basis(const T& lobe, T* out) {
  out[0] = T(static_cast<Plain<T>>(1 / std::numbers::pi));
  out[1] = lobe;
}

}  // namespace gonio
