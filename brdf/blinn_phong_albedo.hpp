// SPDX-License-Identifier: BSD-3-Clause
// Directional albedo of the half-vector cosine lobe, and its normalisations.
#pragma once

#include <cmath>
#include <numbers>

#include "brdf/angle.hpp"

namespace gonio {

/// J(s, θ) = ∫ cos^s θh cos θo dωo over the upper hemisphere, for every real s >= 0 (no normalisation included).
/// With x = sin θ cos t, y = (1+x)/2, p = s/2, k = cos²θ - sin²θ/2 and h = (1 + (p-1) cos²θ)/((p+1)(p+2)):
///   J = 2πh + 2 cos θ ∫_0^π { h (1-y^p)/(1-x) + k y^p/(p+2) + y^p sin²θ sin²t (2+3x)/(2(1+x)) } dt,
/// the form in which neither the near-poles x = ±1 nor the large-s cancellation are left. The integral is taken by the
/// double-exponential rule (Takahasi & Mori 1974) on both halves, which resolves features of any width at t = 0 and t = π.
/// Ends: J(s, 0) = 8π(2^{-s/2}+s)/((s+2)(s+4)) (Giesen 2009), J(s, 90°) = 8π/((s+2)(s+4)).
double half_vector_lobe_integral(double s, Angle theta) noexcept;

/// (s+8)/(8π), the common approximate normalisation: over-reflects, albedo up to 1.0752 at s = 8.764. In any scalar type, as the others.
template <class T>
T blinn_phong_norm(const T& s) {
  return (s + T(8)) * T(0.125 / std::numbers::pi);
}
/// (s+2)(s+4)/(8π(2^{-s/2}+s)), which makes the albedo at normal incidence exactly 1 (Giesen 2009).
template <class T>
T blinn_phong_exact_norm(const T& s) {
  using std::exp;
  return (s + T(2)) / (s + exp(s * T(-0.5 * std::numbers::ln2))) * ((s + T(4)) * T(0.125 / std::numbers::pi));
}
/// (s+2)/(2π): exact for the lobe about the mirror direction at normal incidence; for the half-vector lobe it normalises the
/// distribution of half vectors, and as a BRDF constant is up to four times too bright.
template <class T>
T phong_norm(const T& s) {
  return (s + T(2)) * T(0.5 / std::numbers::pi);
}

}  // namespace gonio
