// SPDX-License-Identifier: BSD-3-Clause
// The models of polished surfaces against each other: ABg, Harvey-Shack and K-correlation meet where their shapes do.
#include "brdf/models/harvey_shack.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

double of(const char* model, std::vector<double> values, const GonioAngles& angles) {
  return AnalyticBrdf(model, single_channel("Y"), {std::move(values)}).eval(angles)[0];
}

}  // namespace

TEST_CASE("ABg with g = 2 is Harvey-Shack with s = -2, and K-correlation is Harvey-Shack times both cosines") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  const double l = 0.03, b0 = 7;
  for (int k = 0; k < 500; ++k) {
    const GonioAngles w{degrees(test::uniform(random, 0, 89)), 30_deg, degrees(test::uniform(random, 0, 89)),
                        degrees(test::uniform(random, 0, 360))};
    CHECK(of("abg", {0.01, b0 * l * l, l * l, 2}, w) == Approx(of("harvey-shack", {0.01, b0, l, -2}, w)).epsilon(1e-12));
    CHECK(of("k-correlation", {0, b0, 1 / l, 1.6}, w) ==
          Approx(of("harvey-shack", {0, b0, l, -2.6}, w) * w.theta_i.cos() * w.theta_o.cos()).epsilon(1e-12));
  }
}

TEST_CASE("the scatter of polished surfaces depends on the projected distance from the mirror direction alone") {
  // β0 = sin 20° and β = sin 50° in plane; the same distance from another incidence.
  const double gap = std::sin(50 * std::numbers::pi / 180) - std::sin(20 * std::numbers::pi / 180);
  const double theta = std::asin(0.1 + gap) * 180 / std::numbers::pi, theta_i = std::asin(0.1) * 180 / std::numbers::pi;
  for (const char* model : {"abg", "harvey-shack"}) {
    const std::vector<double> values =
        std::string(model) == "abg" ? std::vector<double>{0, 1, 0.01, 1.7} : std::vector<double>{0, 1, 0.1, -1.7};
    CHECK(of(model, values, {20_deg, 0_deg, 50_deg, 180_deg}) ==
          Approx(of(model, values, {degrees(theta_i), 0_deg, degrees(theta), 180_deg})));
  }
  CHECK(of("abg", {0, 1, 0.01, 1.7}, {20_deg, 0_deg, 50_deg, 180_deg}) == Approx(1 / (0.01 + std::pow(gap, 1.7))).epsilon(1e-12));
}
