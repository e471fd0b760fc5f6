// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/distributions.hpp"

#include <math.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/beta_function.hpp"

namespace gonio::fitting {
namespace {

constexpr double converged = 1e-16;  // a term that no longer changes the sum
constexpr int most_terms = 100000;   // the series needs about sqrt(dof) terms; this is beyond any data set that fits in memory

/// The root of a falling function on [low, high], by halving until the doubles meet.
template <class F>
double bisect(F&& falling, double low, double high) noexcept {
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (falling(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// ln Γ(x), x > 0. std::lgamma also writes the sign into a global, over which threads would race.
double log_gamma(double x) noexcept {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace

double normal_upper_tail(double z) noexcept { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normal_upper_quantile(double p) noexcept {
  return bisect([p](double z) { return normal_upper_tail(z) - p; }, -40, 40);
}

double chi2_upper_tail(double chi2, double dof) noexcept {
  if (!(chi2 > 0)) return 1;
  const double a = dof / 2, x = chi2 / 2;
  const double scale = std::exp(a * std::log(x) - x - log_gamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < most_terms && term > sum * converged; ++k) sum += term *= x / (a + k);
    return 1 - scale * sum;
  }
  constexpr double tiny = std::numeric_limits<double>::min();
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, fraction = d;
  for (int k = 1; k < most_terms; ++k) {
    const double numerator = -k * (k - a);
    b += 2;
    d = numerator * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + numerator / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    const double factor = d * c;
    fraction *= factor;
    if (std::abs(factor - 1) < 1e-15) break;
  }
  return scale * fraction;
}

double student_two_sided_quantile(double confidence, double dof) noexcept {
  if (dof < 2) return std::tan(confidence * std::numbers::pi / 2);  // one degree of freedom: Cauchy
  const auto shortfall = [&](double t) {
    const double x = t * t / (dof + t * t);
    return confidence - incomplete_beta_half(x, dof / (dof + t * t), dof / 2);
  };
  return bisect(shortfall, 0, 1e6);
}

double binomial_upper_tail(std::size_t k, std::size_t n, double p) noexcept {
  if (k == 0 || p >= 1) return 1;
  if (k > n || p <= 0) return 0;
  const auto count = static_cast<double>(n);
  const auto log_term = [&](double j) {
    return log_gamma(count + 1) - log_gamma(j + 1) - log_gamma(count - j + 1) + j * std::log(p) + (count - j) * std::log1p(-p);
  };
  // The shorter way round the mode: sum the tail itself above it, and one minus the rest below it.
  const auto first = static_cast<double>(k);
  double sum = 0;
  if (first > count * p) {
    double term = std::exp(log_term(first));
    for (double j = first; j <= count && term > sum * converged; ++j) {
      sum += term;
      term *= (count - j) / (j + 1) * (p / (1 - p));
    }
    return sum;
  }
  double term = std::exp(log_term(first - 1));
  for (double j = first - 1; j >= 0 && term > sum * converged; --j) {
    sum += term;
    term *= j / (count - j + 1) * ((1 - p) / p);
  }
  return 1 - sum;
}

double binomial_upper_limit(std::size_t k, std::size_t n, double alpha) noexcept {
  if (n == 0 || k >= n) return 1;
  return bisect([&](double p) { return (1 - binomial_upper_tail(k + 1, n, p)) - alpha; }, 0, 1);
}

}  // namespace gonio::fitting
