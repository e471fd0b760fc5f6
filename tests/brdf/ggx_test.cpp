// SPDX-License-Identifier: BSD-3-Clause
// Special values of the GGX models.
#include "brdf/models/ggx.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

double of(const char* model, std::vector<double> values, const GonioAngles& angles) {
  return AnalyticBrdf(model, single_channel("Y"), {std::move(values)}).eval(angles)[0];
}

}  // namespace

TEST_CASE("GGX at the normal is F0/(4 pi alpha²)") {
  for (const double alpha : {1e-4, 0.01, 0.3, 1.0})
    CHECK(of("ggx", {0, 0.04, 1, alpha}, {0_deg, 0_deg, 0_deg, 0_deg}) == Approx(0.04 / (4 * pi * alpha * alpha)).epsilon(1e-14));
}

TEST_CASE("GGX in the mirror direction is the textbook product of D, G and F") {
  // At theta_h = 0 D = 1/(pi alpha²); both Lambda are (sqrt(1 + alpha² tan²) - 1)/2 and G = 1/(1 + 2 Lambda).
  const double alpha = 0.25, c = std::cos(pi / 3), tan2 = 3;
  const double g = 1 / std::sqrt(1 + alpha * alpha * tan2), f = 0.05 + 0.95 * std::pow(1 - c, 5);
  const double expected = 1 / (pi * alpha * alpha) * g * f / (4 * c * c);
  CHECK(of("ggx", {0, 0.05, 1, alpha}, {60_deg, 20_deg, 60_deg, degrees(200)}) == Approx(expected).epsilon(1e-13));
}

TEST_CASE("GGX evaluates in float as in double") {
  constexpr double float_rounding = 2e-6;  // some 16 roundings of 6e-8
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const LobeGeometry g = lobe_geometry(test::upper_direction(random), test::upper_direction(random));
    const double alpha = std::pow(10.0, test::uniform(random, -3, 0));
    double exact[3];
    float fast[3];
    const float alpha_f = static_cast<float>(alpha);
    const double alpha_d = alpha_f;
    Ggx::basis(g, &alpha_d, exact);
    Ggx::basis(g, &alpha_f, fast);
    for (int j = 1; j < 3; ++j) worst = std::fmax(worst, std::abs(fast[j] - exact[j]) / (exact[1] + exact[2]));
  }
  CHECK(worst < float_rounding);
}

TEST_CASE("separable shadowing is never brighter than the height-correlated one, and equal at the normal") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  int brighter = 0;
  for (int k = 0; k < 2000; ++k) {
    const LobeGeometry g = lobe_geometry(test::upper_direction(random), test::upper_direction(random));
    const double alpha = std::pow(10.0, test::uniform(random, -3, 0.5));
    brighter += ggx_separable_lobe(g, alpha) > ggx_lobe(g, alpha) * (1 + 1e-14);
  }
  CHECK(brighter == 0);
  const LobeGeometry normal = lobe_geometry(GonioAngles{0_deg, 0_deg, 0_deg, 0_deg});
  CHECK(ggx_separable_lobe(normal, 0.3) == Approx(ggx_lobe(normal, 0.3)).epsilon(1e-14));
}

TEST_CASE("the exact Fresnel reflectance has its textbook values") {
  CHECK(dielectric_fresnel(1.0, 1.5) == Approx(0.04).epsilon(1e-13));
  CHECK(dielectric_fresnel(0.0, 1.5) == Approx(1).epsilon(1e-13));
  // At Brewster's angle, tan = n, only s-polarised light is reflected: half of ((n² - 1)/(n² + 1))².
  const double n = 1.5, brewster = (n * n - 1) / (n * n + 1);
  CHECK(dielectric_fresnel(1 / std::sqrt(1 + n * n), n) == Approx(brewster * brewster / 2).epsilon(1e-12));
  // Between, Schlick's approximation is close for a dielectric.
  for (const double c : {0.2, 0.5, 0.8}) CHECK(dielectric_fresnel(c, 1.5) == Approx(0.04 + 0.96 * schlick_weight(c)).margin(0.03));
  CHECK(of("ggx-fresnel", {0, 1, 0.3, 1.5}, {0_deg, 0_deg, 0_deg, 0_deg}) ==
        Approx(of("ggx", {0, 0.04, 1, 0.3}, {0_deg, 0_deg, 0_deg, 0_deg})).epsilon(1e-12));
}
