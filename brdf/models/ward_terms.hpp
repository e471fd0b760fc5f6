// SPDX-License-Identifier: BSD-3-Clause
// What the four forms of Ward's Gaussian lobe share.
#pragma once

#include <algorithm>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// Width of a Ward lobe along one axis: √2 times the root mean square slope.
constexpr Parameter ward_width(std::string_view name, double example) {
  return {name, "1", 1e-4, 10, false, 1e-3, 2, Parameter::Axis::logarithmic, example};
}

/// e^{-tan²θh/α²} / (π α²).
template <class T>
T ward_gaussian(const LobeGeometry& g, const T& alpha) {
  using Real = Plain<T>;
  const T alpha2 = alpha * alpha;
  return static_cast<Real>(1 / std::numbers::pi) * decay<T>(static_cast<Real>(g.tan2_h) / alpha2) / alpha2;
}

/// e^{-tan²θh (cos²φh/αx² + sin²φh/αy²)} / (π αx αy).
template <class T>
T ward_gaussian(const LobeGeometry& g, const T& alpha_x, const T& alpha_y) {
  using Real = Plain<T>;
  const T x = static_cast<Real>(g.slope_x) / alpha_x, y = static_cast<Real>(g.slope_y) / alpha_y;
  return static_cast<Real>(1 / std::numbers::pi) * decay<T>(x * x + y * y) / (alpha_x * alpha_y);
}

/// Ward's own factor, 1/(4 √(cos θi cos θo)); the product of the cosines counts as at least 1e-8.
inline double ward_factor(const LobeGeometry& g) { return 0.25 / std::sqrt(std::max(g.cos_i * g.cos_o, least_cosine_product)); }

/// The factor (h·h)/(h·n)^4 = 1/(cos²θh (cos θi + cos θo)²) of the unnormalised half vector that bounds the albedo.
inline double ward_duer_gm_factor(const LobeGeometry& g) {
  const double hz = g.cos_i + g.cos_o;
  return (1 + g.tan2_h) / (hz * hz);
}

}  // namespace gonio
