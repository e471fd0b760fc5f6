// SPDX-License-Identifier: BSD-3-Clause
// What the two forms of Ashikhmin and Shirley's lobe share.
#pragma once

#include <algorithm>

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// Exponent of the cosine lobe along one axis.
constexpr Parameter ashikhmin_exponent(std::string_view name, double example) {
  return {name, "1", 0, 1e9, false, 1, 1e6, Parameter::Axis::logarithmic, example};
}

/// 1/(8π cos θd max(cos θi, cos θo)). No denominator vanishes where there is a half vector above the surface.
inline double ashikhmin_factor(const LobeGeometry& g) { return 1 / (8 * std::numbers::pi * g.cos_d * std::max(g.cos_i, g.cos_o)); }

}  // namespace gonio
