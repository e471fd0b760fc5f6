// SPDX-License-Identifier: BSD-3-Clause
// Lafortune's lobe: published coefficients, its relation to Phong, its normalisation.
#include "brdf/models/lafortune.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

double of(const char* model, std::vector<double> values, const Direction& wi, const Direction& wo) {
  return AnalyticBrdf(model, single_channel("Y"), {std::move(values)}).eval(wi, wo)[0];
}

}  // namespace

TEST_CASE("published coefficients give the published lobe, mirrored, lifted and retro-reflecting") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  struct Published {
    double amplitude, cxy, cz, n;
  };
  for (const Published& p :
       {Published{0.3, -0.577, 0.577, 40}, Published{2, -1.01, 0.95, 20.3}, Published{0.1, 0.9, 0.7, 8}, Published{1, 0, 1, 3}}) {
    const double delta = std::atan2(p.cz, -p.cxy) * 180 / std::numbers::pi;
    const double rho_s = p.amplitude * (std::pow(std::abs(p.cxy), p.n) + std::pow(p.cz, p.n)) / 2;
    for (int k = 0; k < 200; ++k) {
      const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
      const double d = p.cxy * (wi.x() * wo.x() + wi.y() * wo.y()) + p.cz * wi.z() * wo.z();
      const double expected = d > 0 ? p.amplitude * std::pow(d, p.n) : 0;
      CHECK(of("lafortune", {0, rho_s, p.n, delta}, wi, wo) == Approx(expected).epsilon(1e-9).margin(1e-14 * p.amplitude));
    }
  }
}

TEST_CASE("at 45 degrees the lobe is Phong's, whatever the exponent") {
  for (const double n : {1.0, 30.0, 1e4, 1e7}) {
    const double off = 30 / std::sqrt(n);
    const Direction wi = Direction::spherical(50_deg, 0_deg), wo = Direction::spherical(degrees(50 + off), 180_deg);
    CHECK(of("lafortune", {0.1, 0.4, n, 45}, wi, wo) == Approx(of("phong-1975", {0.1, 0.4, n}, wi, wo)).epsilon(1e-8));
  }
}

TEST_CASE("rho_s is the mean of the peaks at the normal and at grazing") {
  const Direction normal = Direction::spherical(0_deg, 0_deg), in = Direction::spherical(89.99999_deg, 0_deg),
                  out = Direction::spherical(89.99999_deg, 180_deg);
  for (const double delta : {30.0, 45.0, 50.0, 80.0})
    CHECK((of("lafortune", {0, 0.3, 15, delta}, normal, normal) + of("lafortune", {0, 0.3, 15, delta}, in, out)) / 2 ==
          Approx(0.3).epsilon(1e-6));
}
