// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/pair_coordinates.hpp"

#include <cmath>

namespace gonio::tabulated {
namespace {

/// Below this sine of the zenith angle an azimuth is rounding noise.
constexpr double normal = 1e-9;

}  // namespace

PairPoint pair_point(const Direction& wi, const Direction& wo, bool isotropic) noexcept {
  const double scale_i = std::sqrt(2 / (1 + std::fabs(wi.z()))), scale_o = std::sqrt(2 / (1 + std::fabs(wo.z())));
  if (!isotropic) {
    const double tx = scale_i * wi.x(), ty = scale_i * wi.y();
    return {tx + scale_o * wo.x(), ty + scale_o * wo.y(), tx, ty};
  }
  const double r = std::hypot(wi.x(), wi.y());
  if (r < normal) return {scale_o * std::hypot(wo.x(), wo.y()), 0, 0, 0};
  const double c = wi.x() / r, s = wi.y() / r, t = scale_i * r;
  return {t + scale_o * (c * wo.x() + s * wo.y()), scale_o * (c * wo.y() - s * wo.x()), t, 0};
}

}  // namespace gonio::tabulated
