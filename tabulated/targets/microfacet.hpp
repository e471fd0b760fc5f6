// SPDX-License-Identifier: BSD-3-Clause
// What the formulas of renderers share: the anisotropic GGX surface, Fresnel reflectances, and Burley's diffuse term.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/direction.hpp"
#include "brdf/models/microfacet.hpp"

namespace gonio::tabulated::targets {

inline constexpr double inverse_pi = 1 / std::numbers::pi;

/// A pair of directions above the surface, with its half vector.
struct MicrofacetPair {
  double cos_i, cos_o;  ///< > 0
  double hx, hy, hz;    ///< unit half vector
  double cos_d;         ///< of either direction against it

  MicrofacetPair(const Direction& wi, const Direction& wo) : cos_i(wi.z()), cos_o(wo.z()) {
    const double x = wi.x() + wo.x(), y = wi.y() + wo.y(), z = wi.z() + wo.z(), length = std::sqrt(x * x + y * y + z * z);
    hx = x / length, hy = y / length, hz = z / length;
    cos_d = std::min(1.0, length / 2);
  }
};

inline bool above(const Direction& wi, const Direction& wo) { return wi.z() > 0 && wo.z() > 0; }

/// D of the anisotropic GGX surface (B. Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course, Eq. 13).
inline double ggx_d(const MicrofacetPair& p, double ax, double ay) {
  const double x = p.hx / ax, y = p.hy / ay, sum = x * x + y * y + p.hz * p.hz;
  return inverse_pi / (ax * ay * sum * sum);
}
/// cos θ √(1 + tan²θ (ax² cos²φ + ay² sin²φ)) = cos θ (1 + 2 Λ).
inline double smith_root(const Direction& w, double ax, double ay) {
  const double x = ax * w.x(), y = ay * w.y();
  return std::sqrt(x * x + y * y + w.z() * w.z());
}
/// G/(4 cos θi cos θo): the product of Smith's terms, or correlated through the height (E. Heitz, JCGT 3(2), 2014, Eqs. 43 and 99).
inline double separable_visibility(const Direction& wi, const Direction& wo, double ax, double ay) {
  return 1 / ((wi.z() + smith_root(wi, ax, ay)) * (wo.z() + smith_root(wo, ax, ay)));
}
inline double correlated_visibility(const Direction& wi, const Direction& wo, double ax, double ay) {
  return 0.5 / (wo.z() * smith_root(wi, ax, ay) + wi.z() * smith_root(wo, ax, ay));
}

/// Fresnel reflectance of a conductor of index eta - ik for unpolarised light (M. Born, E. Wolf, Principles of Optics, 14.2): with
/// a² + b² = |√(η² - k² - sin² + 2iηk)|² and a its real part.
inline double conductor_fresnel(double c, double eta, double k) {
  const double c2 = c * c, s2 = 1 - c2, t = eta * eta - k * k - s2;
  const double norm = std::sqrt(t * t + 4 * eta * eta * k * k), a = std::sqrt(std::max(0.0, (norm + t) / 2));
  const double rs = (norm + c2 - 2 * a * c) / (norm + c2 + 2 * a * c);
  const double rp = rs * (norm * c2 + s2 * s2 - 2 * a * c * s2) / (norm * c2 + s2 * s2 + 2 * a * c * s2);
  return (rs + rp) / 2;
}
/// Index of a dielectric with this reflectance at the normal.
inline double index_of(double f0) {
  const double root = std::sqrt(std::clamp(f0, 0.0, 0.98));
  return (1 + root) / (1 - root);
}
inline double f0_of(double index) { return (index - 1) * (index - 1) / ((index + 1) * (index + 1)); }

/// Diffuse factor of Burley 2012, 1 at the normal: F_D90 = 1/2 + 2 roughness cos²θd.
inline double burley_diffuse(const MicrofacetPair& p, double roughness) {
  const double f90 = 0.5 + 2 * roughness * p.cos_d * p.cos_d;
  return (1 + (f90 - 1) * schlick_weight(p.cos_i)) * (1 + (f90 - 1) * schlick_weight(p.cos_o));
}

}  // namespace gonio::tabulated::targets
