// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/beta_function.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace gonio {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// ln x with x + y = 1, from whichever of the two is small.
double log_of(double x, double y) noexcept { return y < 0.5 ? std::log1p(-y) : std::log(x); }

/// Σ_n (a+b)_n / (a+1)_n x^n = 2F1(a+b, 1; a+1; x).
double positive_series(double a, double b, double x) noexcept {
  double term = 1, sum = 1;
  for (double n = 0; n < 1e6; ++n) {
    const double ratio = (a + b + n) / (a + 1 + n) * x;
    term *= ratio;
    sum += term;
    // The rest is below term · r/(1-r) once the ratio is under 1 (it only falls for b > 1).
    if (ratio < 1 && term * ratio < 0.25 * eps * sum * (1 - ratio)) break;
  }
  return sum;
}

}  // namespace

double incomplete_beta_half(double x, double one_minus_x, double b) noexcept {
  if (x <= 0) return 0;
  if (one_minus_x <= 0) return 1;
  const double log_complement = log_of(one_minus_x, x);
  // 1 - I < (1-x)^b: below half a rounding error of 1.
  if (-b * log_complement > 40) return 1;
  // 1/B(1/2, b) = Γ(b + 1/2) / (√π Γ(b)) = b R(b) / √π
  const double inverse_beta = b * gamma_ratio_half(b) / std::sqrt(std::numbers::pi);
  const double power = std::sqrt(x) * std::exp(b * log_complement) * inverse_beta;
  if (x <= 0.5) return power * 2 * positive_series(0.5, b, x);
  return 1 - power / b * positive_series(b, 0.5, one_minus_x);
}

}  // namespace gonio
