// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/lobe_integrals.hpp"

#include <algorithm>
#include <random>

#include "brdf/beta_function.hpp"
#include "brdf/lobe_geometry.hpp"
#include "brdf/model.hpp"

namespace gonio::tools::tradeoff {
namespace {

using std::numbers::pi;

double log_cosine(Lobe lobe, const LobeGeometry& g) { return lobe == Lobe::mirror ? g.log_cos_psi : g.log_cos_h; }

/// The integrand after u = cos^{s+1} of the lobe's angle, over (u, azimuth): cos θo for the mirror lobe, 4 cos θd cos θo for the
/// half-vector lobe (dωo = 4 cos θd dωh), times 1/(s+1).
class MappedLobe {
 public:
  MappedLobe(Lobe lobe, double s, Angle theta) : lobe_(lobe), s_(s), sine_(theta.sin()), cosine_(theta.cos()) {}

  double operator()(double u, double azimuth) const {
    const double log_cos = std::log(u) / (s_ + 1);
    const double c = std::exp(log_cos), r = std::sqrt(-std::expm1(2 * log_cos));
    const double x = r * std::cos(azimuth);
    if (lobe_ == Lobe::mirror) return std::max(0.0, cosine_ * c + sine_ * x) / (s_ + 1);  // polar axis along the mirror direction
    const double cos_d = sine_ * x + cosine_ * c;
    const double cos_o = 2 * cos_d * c - cosine_;
    return cos_d > 0 && cos_o > 0 ? 4 * cos_d * cos_o / (s_ + 1) : 0.0;
  }

 private:
  Lobe lobe_;
  double s_, sine_, cosine_;
};

/// A = cos θ + (s+2)/(2π) ∫_0^θ sin(v) √π R(s/2+1) sin^s(θ - v) dv, then times 2π/(s+2).
long double mirror_integral(long double s, long double theta) {
  constexpr long double pil = std::numbers::pi_v<long double>;
  const long double scale = 2 * pil / (s + 2);
  if (theta == 0) return scale;
  const long double K = std::sqrt(pil) * gamma_ratio_half(s / 2 + 1);
  // Beyond this v the integrand is below e^-90 of its largest value.
  const long double reach = std::min(theta, std::min(90 * std::tan(theta) / s, std::sqrt(180 / s)));
  long double sum = 0;
  constexpr long double step = 1.0L / 128;
  for (int j = -512; j <= 512; ++j) {
    const long double tau = j * step, z = pil * std::sinh(tau);
    const long double v = reach / (1 + std::exp(-z));
    const long double rest = theta - v;
    if (!(rest > 0)) continue;
    const long double weight = reach * pil * std::cosh(tau) * step / (2 + 2 * std::cosh(z));
    const long double log_sine = rest > 1 ? 0.5L * std::log1p(-std::cos(rest) * std::cos(rest)) : std::log(std::sin(rest));
    sum += weight * std::sin(v) * std::exp(s * log_sine);
  }
  return scale * std::cos(theta) + K * sum;
}

}  // namespace

GaussLegendre::GaussLegendre(int n) {
  // Newton's iteration on the Legendre polynomial, from Tricomi's estimate of its zeros.
  for (int k = 0; k < n; ++k) {
    double x = std::cos(pi * (k + 0.75) / (n + 0.5)), slope = 0;
    for (int round = 0; round < 100; ++round) {
      double previous = 1, value = x;
      for (int j = 2; j <= n; ++j) {
        const double next = ((2 * j - 1) * x * value - (j - 1) * previous) / j;
        previous = value, value = next;
      }
      slope = n * (x * value - previous) / (x * x - 1);
      const double change = value / slope;
      x -= change;
      if (std::fabs(change) < 1e-15) break;
    }
    node.push_back((1 + x) / 2);
    weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

double product_quadrature(Lobe lobe, double s, Angle theta, const GaussLegendre& rule) {
  const Direction wi = Direction::spherical(theta, 0_deg);
  const std::size_t azimuths = 2 * rule.node.size();
  double sum = 0;
  for (std::size_t a = 0; a < azimuths; ++a) {
    const double phi = 2 * pi * (static_cast<double>(a) + 0.5) / static_cast<double>(azimuths);
    const double cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double z = rule.node[k], r = std::sqrt(1 - z * z);
      const LobeGeometry g = lobe_geometry(wi, Direction::trusted(r * cos_phi, r * sin_phi, z));
      sum += rule.weight[k] * z * cosine_power(log_cosine(lobe, g), s);
    }
  }
  return sum * 2 * pi / static_cast<double>(azimuths);
}

double lobe_mapped_quadrature(Lobe lobe, double s, Angle theta, const GaussLegendre& rule) {
  const MappedLobe integrand(lobe, s, theta);
  const std::size_t azimuths = 2 * rule.node.size();
  double sum = 0;
  for (std::size_t a = 0; a < azimuths; ++a)
    for (std::size_t k = 0; k < rule.node.size(); ++k)
      sum += rule.weight[k] * integrand(rule.node[k], 2 * pi * (static_cast<double>(a) + 0.5) / static_cast<double>(azimuths));
  return sum * 2 * pi / static_cast<double>(azimuths);
}

double lobe_monte_carlo(Lobe lobe, double s, Angle theta, std::size_t count, std::uint64_t seed) {
  const MappedLobe integrand(lobe, s, theta);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double u = uniform();
    sum += integrand(u, 2 * pi * uniform());
  }
  return sum * 2 * pi / static_cast<double>(count);
}

double true_integral(Lobe lobe, double s, double theta_deg) {
  const long double degree = std::numbers::pi_v<long double> / 180;
  const long double theta = static_cast<long double>(theta_deg) * degree, elevation = static_cast<long double>(90 - theta_deg) * degree;
  if (lobe == Lobe::mirror) return static_cast<double>(mirror_integral(s, theta));
  constexpr int enough = 16384;  // the integrand's narrowest feature at s = 1e6, 89° needs 1024 points for the last digit of a double
  return static_cast<double>(periodic_rule<long double>(s, std::sin(elevation), std::sin(theta), enough));
}

}  // namespace gonio::tools::tradeoff
