// SPDX-License-Identifier: BSD-3-Clause
// The albedo integral of a cosine lobe by the rules that compete with the product's own, in any floating-point type where truth is needed.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "brdf/angle.hpp"

namespace gonio::tools::tradeoff {

/// Which direction the lobe is about.
enum class Lobe { mirror, half_vector };

/// J(s, θ) = ∫ cos^s θh cos θo dωo by the n-point midpoint rule on
///   2C ∫_0^π { (H(x) - H(-1))/(1+x) + y^p (S²-x²)(2+3x)/(2(1+x)) } dt + 2π H(-1),  x = S cos t, y = (1+x)/2, p = s/2,
/// H = 2[(S²-C²)(1-y^{p+1})/(p+1) + 2k(1-y^{p+2})/(p+2)]/(1-x), k = C² - S²/2, H(-1) = (S²-C²)/(p+1) + 2k/(p+2).
/// The integrand is analytic and periodic: the error falls geometrically with n, at a rate that sinks with growing s and θ.
template <class T>
T periodic_rule(T s, T cos_theta, T sin_theta, int n) {
  constexpr T pi = std::numbers::pi_v<T>;
  const T C = cos_theta, S = sin_theta, p = s / 2, k = C * C - S * S / 2;
  const T at_minus_one = (S * S - C * C) / (p + 1) + 2 * k / (p + 2);
  T sum = 0;
  for (int j = 0; j < n; ++j) {
    const T t = pi * (static_cast<T>(j) + T(0.5)) / static_cast<T>(n);
    const T half_sine = std::sin(t / 2), half_cosine = std::cos(t / 2);
    const T one_minus_x = C * C / (1 + S) + 2 * S * half_sine * half_sine;     // 1 - S + S (1 - cos t)
    const T one_plus_x = C * C / (1 + S) + 2 * S * half_cosine * half_cosine;  // 1 - S + S (1 + cos t)
    const T x = (one_plus_x - one_minus_x) / 2;
    const T log_y = one_minus_x < 1 ? std::log1p(-one_minus_x / 2) : std::log(one_plus_x / 2);
    const T h =
        -2 * ((S * S - C * C) * std::expm1((p + 1) * log_y) / (p + 1) + 2 * k * std::expm1((p + 2) * log_y) / (p + 2)) / one_minus_x;
    sum += (h - at_minus_one) / one_plus_x + std::exp(p * log_y) * (S * S - x * x) * (2 + 3 * x) / (2 * one_plus_x);
  }
  return 2 * C * sum * pi / static_cast<T>(n) + 2 * pi * at_minus_one;
}

/// Nodes and weights of the Gauss-Legendre rule on [0, 1].
struct GaussLegendre {
  std::vector<double> node, weight;
  explicit GaussLegendre(int n);
};

/// ∫ cos^s cos θo dωo by Gauss-Legendre in cos θo (n nodes) and the midpoint rule in φo (2n): knows nothing of the lobe.
double product_quadrature(Lobe lobe, double s, Angle theta, const GaussLegendre& rule);
/// The same after the substitution u = cos^{s+1} of the lobe's angle, which makes the lobe flat: Gauss-Legendre in u (n), midpoint in
/// azimuth (2n). What is left is the horizon, where the integrand has a kink.
double lobe_mapped_quadrature(Lobe lobe, double s, Angle theta, const GaussLegendre& rule);
/// The same substitution with `count` independent random points.
double lobe_monte_carlo(Lobe lobe, double s, Angle theta, std::size_t count, std::uint64_t seed);

/// The integral to about 1e-17, by ways that share nothing with the product's code: for the half-vector lobe the periodic rule in long
/// double, for the mirror lobe the solution of F'' + F = √π Γ((s+3)/2)/Γ(s/2+2) sin^s θ as a convolution, by the double-exponential rule
/// in long double.
double true_integral(Lobe lobe, double s, double theta_deg);

}  // namespace gonio::tools::tradeoff
