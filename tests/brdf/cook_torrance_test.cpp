// SPDX-License-Identifier: BSD-3-Clause
// Cook and Torrance's model against the formula of the paper and against its neighbours.
#include "brdf/models/cook_torrance.hpp"

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

double of(const char* model, std::vector<double> values, const Direction& wi, const Direction& wo) {
  return AnalyticBrdf(model, single_channel("Y"), {std::move(values)}).eval(wi, wo)[0];
}

}  // namespace

TEST_CASE("Cook-Torrance is the textbook product of D, G and F") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (int k = 0; k < 500; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), length = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double ch = hz / length, cd = length / 2, m = 0.6;
    const double d = std::exp((ch * ch - 1) / (m * m * ch * ch)) / (pi * m * m * std::pow(ch, 4));
    const double g = std::min({1.0, 2 * ch * wi.z() / cd, 2 * ch * wo.z() / cd});
    const double f = 0.1 + 0.7 * std::pow(1 - cd, 5);
    CHECK(of("cook-torrance", {0.2, 0.1, 0.8, m}, wi, wo) == Approx(0.2 / pi + d * g * f / (4 * wi.z() * wo.z())).epsilon(1e-11));
  }
}

TEST_CASE("the grooves' shadowing has a limit at the horizon") {
  const LobeGeometry horizon = lobe_geometry(GonioAngles{90_deg, 0_deg, 40_deg, 170_deg}),
                     near = lobe_geometry(GonioAngles{89.99999_deg, 0_deg, 40_deg, 170_deg});
  CHECK(v_groove_visibility(horizon) == Approx(v_groove_visibility(near)).epsilon(1e-6));
  CHECK(v_groove_visibility(horizon) > 0);
}

TEST_CASE("narrow lobes of all the Gaussian kind agree near the normal") {
  // Beckmann with m, Ward with alpha = m, Ashikhmin-Shirley with n = 2/m²; they differ by terms in the square of the angles and of m.
  const double m = 0.01;
  for (const double off : {0.0, 0.5, 1.0, 2.0}) {
    const Direction wi = Direction::spherical(degrees(off), 0_deg), wo = Direction::spherical(0_deg, 0_deg);
    const double reference = of("cook-torrance", {0, 1, 1, m}, wi, wo);
    INFO(off);
    CHECK(of("ward", {0, 1, m}, wi, wo) == Approx(reference).epsilon(3e-3));
    CHECK(of("ward-duer-gm", {0, 1, m}, wi, wo) == Approx(reference).epsilon(3e-3));
    CHECK(of("ashikhmin-shirley", {0, 1, 1, 2 / (m * m)}, wi, wo) == Approx(reference).epsilon(3e-3));
    CHECK(of("blinn-phong-ngan", {0, 0.25, 2 / (m * m)}, wi, wo) == Approx(reference).epsilon(3e-3));
  }
}
