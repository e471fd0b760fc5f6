// SPDX-License-Identifier: BSD-3-Clause
// Oren and Nayar's diffuse surface against the formula of the paper.
#include "brdf/models/oren_nayar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("Oren-Nayar is the formula of the paper, and without slopes Lambert's") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  const double sigma = 30 * pi / 180, s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  const AnalyticBrdf rough("oren-nayar", single_channel("Y"), {{0.4, 30}}), smooth("oren-nayar", single_channel("Y"), {{0.4, 0}});
  for (int k = 0; k < 500; ++k) {
    const GonioAngles w{degrees(test::uniform(random, 0, 89)), degrees(test::uniform(random, 0, 360)),
                        degrees(test::uniform(random, 0, 89)), degrees(test::uniform(random, 0, 360))};
    const double larger = std::max(w.theta_i.radians(), w.theta_o.radians()), smaller = std::min(w.theta_i.radians(), w.theta_o.radians());
    const double along = std::max(0.0, std::cos(w.phi_i.radians() - w.phi_o.radians()));
    CHECK(rough.eval(w)[0] == Approx(0.4 / pi * (a + b * along * std::sin(larger) * std::tan(smaller))).epsilon(1e-11));
    CHECK(smooth.eval(w)[0] == Approx(0.4 / pi).epsilon(1e-15));
  }
}

TEST_CASE("a rough diffuse surface is brightest towards the light, and its albedo is A at the normal and A + B/2 at grazing") {
  const AnalyticBrdf rough("oren-nayar", single_channel("Y"), {{1, 40}});
  const double sigma = 40 * pi / 180, s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
  CHECK(rough.eval({60_deg, 0_deg, 60_deg, 0_deg})[0] > rough.eval({60_deg, 0_deg, 60_deg, 180_deg})[0]);
  CHECK(rough.directional_albedo(0_deg)[0] == Approx(a).epsilon(1e-14));
  CHECK(rough.directional_albedo(90_deg)[0] == Approx(a + b / 2).epsilon(1e-14));
  // Between, the product rule in angles; nodes on neither kink.
  const Angle theta_i = 85_deg;
  double sum = 0;
  constexpr int n = 600;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Angle theta_o = degrees((row + 0.5) * 90.0 / n);
      sum += rough.eval({theta_i, 0_deg, theta_o, degrees((column + 0.5) * 360.0 / n)})[0] * theta_o.sin() * theta_o.cos();
    }
  CHECK(rough.directional_albedo(theta_i)[0] == Approx(sum * (pi / 2 / n) * (2 * pi / n)).epsilon(1e-4));
  CHECK(rough.albedo_bound()[0] >= rough.directional_albedo(60_deg)[0]);
}

TEST_CASE("a sum takes the rough diffuse part of its first term") {
  const AnalyticBrdf sum("oren-nayar+phong", single_channel("Y"), {{0.4, 0.3, 30, 50}});
  const AnalyticBrdf rough("oren-nayar", single_channel("Y"), {{0.4, 30}}), lobe("phong", single_channel("Y"), {{0, 0.3, 50}});
  const GonioAngles w{50_deg, 0_deg, 45_deg, 175_deg};
  CHECK(sum.eval(w)[0] == Approx(rough.eval(w)[0] + lobe.eval(w)[0]).epsilon(1e-14));
}
