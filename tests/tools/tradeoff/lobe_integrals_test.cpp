// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/lobe_integrals.hpp"

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/phong_albedo.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tools::tradeoff;

TEST_CASE("the truth of the albedo topic agrees with 36-digit values computed elsewhere") {
  // A_P(s, θ) of the mirror lobe and A of the half-vector lobe with (s+8)/(8π), from the golden table.
  const auto mirror = [](double s, double theta) { return (s + 2) / (2 * std::numbers::pi) * true_integral(Lobe::mirror, s, theta); };
  const auto half = [](double s, double theta) { return blinn_phong_norm(s) * true_integral(Lobe::half_vector, s, theta); };
  constexpr double few_roundings = 1e-15;
  CHECK(mirror(1, 45) == Approx(0.75540916492918716069).epsilon(few_roundings));
  CHECK(mirror(10, 80) == Approx(0.22805629254869144791).epsilon(few_roundings));
  CHECK(mirror(1e3, 89) == Approx(0.023212292717435947464).epsilon(few_roundings));
  CHECK(mirror(1e6, 0) == Approx(1).epsilon(few_roundings));
  CHECK(half(1, 45) == Approx(0.92007885184931532970).epsilon(few_roundings));
  CHECK(half(10, 80) == Approx(0.18951162701002061821).epsilon(few_roundings));
  CHECK(half(1e3, 89) == Approx(0.0018297857483218401585).epsilon(few_roundings));
}

TEST_CASE("every rule comes near the truth of a broad lobe, and the plain product rule loses a narrow one") {
  const GaussLegendre rule(48);
  for (const Lobe lobe : {Lobe::mirror, Lobe::half_vector})
    for (const double theta : {0.0, 60.0}) {
      INFO("theta " << theta);
      const double truth = true_integral(lobe, 10, theta);
      CHECK(product_quadrature(lobe, 10, degrees(theta), rule) == Approx(truth).epsilon(1e-5));
      CHECK(lobe_mapped_quadrature(lobe, 10, degrees(theta), rule) == Approx(truth).epsilon(1e-3));
      CHECK(lobe_monte_carlo(lobe, 10, degrees(theta), 100000, 7) == Approx(truth).epsilon(0.02));
    }
  CHECK(periodic_rule(1e3, (80_deg).cos(), (80_deg).sin(), 64) == Approx(half_vector_lobe_integral(1e3, 80_deg)).epsilon(1e-13));
  CHECK(product_quadrature(Lobe::mirror, 1e6, 45_deg, rule) < 0.5 * true_integral(Lobe::mirror, 1e6, 45));
}
