// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/phong_albedo.hpp"

#include <cmath>
#include <numbers>

#include "brdf/beta_function.hpp"

namespace gonio {

double phong_albedo(double s, Angle theta) noexcept {
  const double c = std::fmax(theta.cos(), 0.0), sine = std::fabs(theta.sin());
  const double bracket = 0.5 + 0.5 * incomplete_beta_half(c * c, sine * sine, s / 2 + 1);
  double ring = 0;
  if (sine > 0) {
    const double log_sine = c < 0.7 ? 0.5 * std::log1p(-c * c) : std::log(sine);
    ring = std::exp((s + 2) * log_sine) * gamma_ratio_half(s / 2) / (2 * std::sqrt(std::numbers::pi));
  }
  return c * bracket + ring;
}

}  // namespace gonio
