// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/rough_interface.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using gonio::tabulated::targets::RoughInterface;
namespace test = gonio::test;

namespace {

constexpr auto separable = RoughInterface::Shadowing::separable, correlated = RoughInterface::Shadowing::correlated;
constexpr auto trapezoidal = RoughInterface::Mean::trapezoidal, of_nodes = RoughInterface::Mean::of_nodes;

using Vector = std::array<double, 3>;

/// One event at the surface, seen from a side on which the direction points up: a normal is drawn by the slopes that a GGX surface of this
/// width shows (Heitz 2018: a disc seen from the direction), and the light goes the way of a coin that knows Fresnel's reflectance.
struct Event {
  bool reflected;
  double cosine;  ///< to the normal of the surface, on the side the light goes to; <= 0: lost in the surface
  double weight;  ///< of the shadowing of the way out
};
Event meet(test::Random& random, const Vector& w, double alpha, double index) {
  const double length = std::hypot(alpha * w[0], alpha * w[1], w[2]);
  const Vector v{alpha * w[0] / length, alpha * w[1] / length, w[2] / length};
  const double flat = std::hypot(v[0], v[1]);
  const Vector a = flat > 0 ? Vector{-v[1] / flat, v[0] / flat, 0} : Vector{1, 0, 0};
  const Vector b{v[1] * a[2] - v[2] * a[1], v[2] * a[0] - v[0] * a[2], v[0] * a[1] - v[1] * a[0]};
  const double r = std::sqrt(test::uniform(random, 0, 1)), phi = test::uniform(random, 0, 2 * std::numbers::pi), half = (1 + v[2]) / 2;
  const double p = r * std::cos(phi), q = (1 - half) * std::sqrt(1 - p * p) + half * r * std::sin(phi);
  const double up = std::sqrt(std::max(0.0, 1 - p * p - q * q));
  Vector m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = p * a[k] + q * b[k] + up * v[k];
  m = {alpha * m[0], alpha * m[1], std::max(1e-9, m[2])};
  const double norm = std::hypot(m[0], m[1], m[2]), mz = m[2] / norm, c = (w[0] * m[0] + w[1] * m[1] + w[2] * m[2]) / norm;
  const double sin2_t = (1 - c * c) / (index * index), t = std::sqrt(std::max(0.0, 1 - sin2_t));
  const double rs = (c - index * t) / (c + index * t), rp = (index * c - t) / (index * c + t);
  const double fresnel = sin2_t >= 1 ? 1 : (rs * rs + rp * rp) / 2;
  const auto lambda = [&](double z) { return (std::sqrt(1 + alpha * alpha * (1 / (z * z) - 1)) - 1) / 2; };
  Event out;
  out.reflected = test::uniform(random, 0, 1) < fresnel;
  out.cosine = out.reflected ? 2 * c * mz - w[2] : (t - c / index) * mz + w[2] / index;
  out.weight = out.cosine > 0 ? (1 + lambda(w[2])) / (1 + lambda(w[2]) + lambda(out.cosine)) : 0;
  return out;
}

Vector tilted(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

}  // namespace

TEST_CASE("light that walks between a rough surface and a diffuse base comes out as the formula says") {
  // Correlated shadowing, as pbrt's layered material walks. From outside through the surface, then between base and surface until it is
  // out.
  INFO("seed " << test::seed);
  constexpr double alpha = 0.3, index = 1.5, albedo = 0.8, cos_o = 0.7;
  constexpr int walks = 200000;
  test::Random random(test::seed);
  double sum = 0, squares = 0;
  for (int k = 0; k < walks; ++k) {
    double light = 0;
    const Event enter = meet(random, tilted(cos_o), alpha, index);
    double carried = enter.reflected || enter.cosine <= 0 ? 0 : enter.weight;
    for (int turn = 0; turn < 200 && carried > 0; ++turn) {
      carried *= albedo;
      const double z = std::sqrt(test::uniform(random, 1e-12, 1));  // of the cosine-weighted directions above the base
      const Event event = meet(random, tilted(z), alpha, 1 / index);
      if (event.cosine <= 0) break;
      carried *= event.weight;
      if (!event.reflected) light = carried;
      if (!event.reflected) break;
    }
    sum += light, squares += light * light;
  }
  const double mean = sum / walks, sigma = std::sqrt((squares / walks - mean * mean) / walks);
  const RoughInterface surface(alpha, index, correlated, trapezoidal);
  double wanted = 0;
  constexpr int steps = 2000;
  for (int k = 0; k < steps; ++k) {
    const double z = (k + 0.5) / steps;
    wanted += 2 * std::numbers::pi * z * surface.diffuse(albedo, z, cos_o) / steps;
  }
  INFO("walked " << mean << " ± " << sigma << ", formula " << wanted);
  // Four standard deviations of the walk, and half a percent of the quadrature of t and r at the edge of total reflection.
  CHECK(std::abs(mean - wanted) <= 4 * sigma + 0.005 * wanted);
  CHECK(sigma < 0.003 * wanted);
}

TEST_CASE("a nearly smooth interface transmits what Fresnel leaves and reflects the known share of diffuse light") {
  const double n = 1.5;
  const RoughInterface surface(1e-3, n, separable, trapezoidal);
  CHECK(surface.transmittance(1) == Approx(1 - 0.04).margin(1e-4));
  const double c = 31.0 / 63, t = std::sqrt(1 - (1 - c * c) / (n * n));
  const double rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
  CHECK(surface.transmittance(c) == Approx(1 - (rs * rs + rp * rp) / 2).margin(1e-3));
  // Diffuse light inside is reflected to 59.6 % at n = 1.5 (E. d'Eon, G. Irving, A Quantized-Diffusion Model, TOG 30(4), 2011).
  CHECK(surface.internal_reflectance() == Approx(0.596).margin(0.01));
}

TEST_CASE("rough interfaces lose energy to single scattering, less of it with correlated shadowing") {
  const RoughInterface product(0.5, 1.5, separable, trapezoidal), together(0.5, 1.5, correlated, trapezoidal);
  for (const double cosine : {0.2, 0.5, 0.9}) {
    CHECK(product.transmittance(cosine) > 0.5);
    CHECK(product.transmittance(cosine) < together.transmittance(cosine));
    CHECK(together.transmittance(cosine) < 1);
  }
  CHECK(product.internal_reflectance() < together.internal_reflectance());
  CHECK(RoughInterface(0.5, 1.5, separable, of_nodes).internal_reflectance() != Approx(product.internal_reflectance()).epsilon(1e-4));
}

TEST_CASE("the diffuse part is reciprocal, grows with the albedo, and keeps below a perfect diffuser") {
  const RoughInterface surface(0.2, 1.5, separable, of_nodes);
  CHECK(surface.diffuse(0.6, 0.3, 0.8) == Approx(surface.diffuse(0.6, 0.8, 0.3)).epsilon(1e-14));
  CHECK(surface.diffuse(0.6, 0.3, 0.8) > 2 * surface.diffuse(0.3, 0.3, 0.8));
  CHECK(surface.diffuse(1, 1, 1) < 1.1 / 3.14159);
}
