// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/polar_integral.hpp"

#include <cmath>
#include <numbers>

#include "brdf/angle.hpp"

namespace gonio::tabulated {

double polar_integral(std::span<const double> theta_deg, std::span<const double> phi_deg, std::span<const double> f) {
  constexpr double radian = std::numbers::pi / 180;
  const auto ring = [&](std::size_t t) {
    const std::span<const double> row = f.subspan(t * phi_deg.size(), phi_deg.size());
    if (row.size() == 1) return 2 * std::numbers::pi * row[0];
    double sum = 0;
    for (std::size_t p = 0; p + 1 < row.size(); ++p) sum += (row[p] + row[p + 1]) / 2 * (phi_deg[p + 1] - phi_deg[p]) * radian;
    return sum + (row.back() + row.front()) / 2 * (phi_deg.front() + 360 - phi_deg.back()) * radian;
  };
  const auto weighted = [&](std::size_t t) {
    const Angle theta = degrees(theta_deg[t]);
    return ring(t) * std::fabs(theta.cos()) * theta.sin();
  };
  double sum = 0;
  for (std::size_t t = 0; t + 1 < theta_deg.size(); ++t)
    sum += (weighted(t) + weighted(t + 1)) / 2 * (theta_deg[t + 1] - theta_deg[t]) * radian;
  return sum;
}

}  // namespace gonio::tabulated
