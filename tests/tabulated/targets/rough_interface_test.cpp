// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/rough_interface.hpp"

#include <cmath>

#include "tests/check.hpp"

using gonio::tabulated::targets::RoughInterface;

namespace {

constexpr auto separable = RoughInterface::Shadowing::separable, correlated = RoughInterface::Shadowing::correlated;
constexpr auto trapezoidal = RoughInterface::Mean::trapezoidal, of_nodes = RoughInterface::Mean::of_nodes;

}  // namespace

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
