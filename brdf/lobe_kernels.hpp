// SPDX-License-Identifier: BSD-3-Clause
// The geometry of the lobes from plain vectors in float, double or long double, in the forms that lose no digits at the hard places.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace gonio {

/// A vector without a frame, for kernels that run over many directions. `wi` and `wo` below are unit vectors away from the surface, in the
/// frame of the sample, rounded to T: what T cannot hold of them is lost, but the kernels lose nothing more.
template <class T>
struct Vector3 {
  T x, y, z;
};

/// ln cos θh = -1/2 ln(1 + tan² θh) with tan² θh = (hx²+hy²)/hz² of the unnormalised half vector h = wi + wo: no normalisation and no
/// acos, so that exp(s ln cos θh) is good to a few roundings for every s. -inf where hz <= 0.
template <class T>
T log_cos_half(const Vector3<T>& wi, const Vector3<T>& wo) {
  const T hx = wi.x + wo.x, hy = wi.y + wo.y, hz = wi.z + wo.z;
  return hz > 0 ? T(-0.5) * std::log1p((hx * hx + hy * hy) / (hz * hz)) : -std::numeric_limits<T>::infinity();
}

/// ln cos ψ with ψ between wo and the mirrored wi: ln(1 - 2 sin²(ψ/2)), sin²(ψ/2) = |wo - r|²/4. The difference is exact when both are
/// close (Sterbenz); far from the peak the dot product has the smaller error. Only sums and products that do not change when wi and wo
/// are exchanged, so that the lobe is reciprocal to the last bit. -inf where cos ψ <= 0.
template <class T>
T log_cos_mirror(const Vector3<T>& wi, const Vector3<T>& wo) {
  const T dx = wi.x + wo.x, dy = wi.y + wo.y, dz = wo.z - wi.z;
  const T cos_psi = wi.z * wo.z - (wi.x * wo.x + wi.y * wo.y);
  const T half_sin2 = (dx * dx + dy * dy + dz * dz) / 4;
  if (!(cos_psi > 0)) return -std::numeric_limits<T>::infinity();
  return half_sin2 < T(0.25) ? std::log1p(-2 * half_sin2) : std::log(cos_psi);
}

/// θh = atan2(|h_xy|, hz): keeps every digit near 0, where acos(hz) loses half of them.
template <class T>
T theta_half(const Vector3<T>& wi, const Vector3<T>& wo) {
  return std::atan2(std::hypot(wi.x + wo.x, wi.y + wo.y), wi.z + wo.z);
}

/// θd = atan2(|wi - wo|, |wi + wo|): keeps every digit near retro-reflection.
template <class T>
T theta_difference(const Vector3<T>& wi, const Vector3<T>& wo) {
  return std::atan2(std::hypot(wi.x - wo.x, wi.y - wo.y, wi.z - wo.z), std::hypot(wi.x + wo.x, wi.y + wo.y, wi.z + wo.z));
}

/// θh from elevations over the surface and `gap`, the azimuth between wo and the mirror direction (all in radians):
///   tan θh = hypot(sin θi - sin θo, 2 √(sin θi sin θo) sin(gap/2)) / (cos θi + cos θo),
/// the cosines as sines of the elevation and the difference in product form. Cartesian vectors cannot hold grazing mirrored pairs: at an
/// elevation of 1e-8 their θh is wrong by 0.5 rad in float.
template <class T>
T theta_half_from_elevations(T elevation_i, T elevation_o, T gap) {
  const T difference = 2 * std::sin((elevation_i + elevation_o) / 2) * std::sin((elevation_o - elevation_i) / 2);
  const T sines = std::cos(elevation_i) * std::cos(elevation_o);
  return std::atan2(std::hypot(difference, 2 * std::sqrt(sines) * std::sin(gap / 2)), std::sin(elevation_i) + std::sin(elevation_o));
}

/// exp(exponent), 0 below what T still holds as a normal number: a denormal result is several times slower and of no use in a sum.
template <class T>
T lobe_exponential(T exponent) {
  constexpr T least = std::is_same_v<T, float> ? T(-87) : T(-700);
  return exponent < least ? T(0) : std::exp(exponent);
}

}  // namespace gonio
