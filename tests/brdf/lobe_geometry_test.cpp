// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/lobe_geometry.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("the lobe cosines from angles and from vectors agree") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  constexpr double rounding_only = 4e-15;  // a few rounding errors of quantities of order 1
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const GonioAngles a{degrees(test::uniform(random, 1, 89)), degrees(test::uniform(random, -180, 180)),
                        degrees(test::uniform(random, 1, 89)), degrees(test::uniform(random, -180, 180))};
    const LobeGeometry x = lobe_geometry(a), y = lobe_geometry(a.wi(), a.wo());
    worst = std::fmax(worst, std::fabs(std::exp(x.log_cos_h) - std::exp(y.log_cos_h)));
    worst = std::fmax(worst, std::fabs(std::exp(x.log_cos_psi) - std::exp(y.log_cos_psi)));
  }
  CHECK(worst < rounding_only);
}

TEST_CASE("the lobe keeps its digits near the peak for any exponent") {
  // psi = 1e-5 rad off the mirror direction: ln cos psi = -5e-11 to full precision, where log(dot) has 6 digits left.
  const double offset_deg = 1e-5 * 180 / std::numbers::pi;
  const LobeGeometry g = lobe_geometry(GonioAngles{0_deg, 0_deg, degrees(offset_deg), 0_deg});
  const double exact = std::log1p(-2 * std::pow(std::sin(offset_deg * std::numbers::pi / 360), 2));
  CHECK(g.log_cos_psi == Approx(exact).epsilon(1e-14));
  CHECK(std::fabs(std::log(std::cos(1e-5)) / exact - 1) > 1e-9);  // the naive form fails this gate
}

TEST_CASE("grazing, nearly mirrored pairs keep theta_h") {
  // elevation e on both sides, azimuths pi - e apart: theta_h tends to atan(1/2) for every small e
  for (const double e : {1e-2, 1e-4, 1e-6}) {
    const LobeGeometry g = lobe_geometry(GonioAngles{degrees(90 - e), 0_deg, degrees(90 - e), degrees(180 - e)});
    const double tan_h = std::sqrt(std::expm1(-2 * g.log_cos_h));
    CHECK(tan_h == Approx(0.5).epsilon(e));
  }
}

TEST_CASE("the lobe geometry does not change at all when the directions are exchanged") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  int different = 0;
  for (int k = 0; k < 10000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const LobeGeometry a = lobe_geometry(wi, wo), b = lobe_geometry(wo, wi);
    different += a.log_cos_h != b.log_cos_h || a.log_cos_psi != b.log_cos_psi;
  }
  CHECK(different == 0);
}

TEST_CASE("there is no lobe where its cosine is not positive") {
  CHECK(lobe_geometry(GonioAngles{60_deg, 0_deg, 60_deg, 0_deg}).log_cos_psi == LobeGeometry::no_lobe);
  CHECK(lobe_geometry(GonioAngles{90_deg, 0_deg, 90_deg, 90_deg}).log_cos_h == LobeGeometry::no_lobe);
}

TEST_CASE("every quantity of the geometry agrees from angles and from vectors, and does not change when wi and wo are exchanged") {
  test::Random random(test::seed);
  for (int k = 0; k < 2000; ++k) {
    const GonioAngles a = test::gonio_pair(random);
    const Direction wi = a.wi(), wo = a.wo();
    const LobeGeometry x = lobe_geometry(a), y = lobe_geometry(wi, wo), z = lobe_geometry(wo, wi);
    if (!x.above_horizon()) continue;
    const double hz = x.cos_i + x.cos_o;
    CHECK(x.cos_d == Approx(y.cos_d).epsilon(1e-13));
    CHECK(x.beta_gap == Approx(y.beta_gap).margin(1e-13));
    CHECK(x.slope_x * hz == Approx(y.slope_x * hz).margin(1e-13));
    CHECK(x.slope_y * hz == Approx(y.slope_y * hz).margin(1e-13));
    CHECK(x.product_x == Approx(y.product_x).margin(1e-13));
    CHECK(x.product_y == Approx(y.product_y).margin(1e-13));
    // Far from 90°, where the logarithm has no digits left.
    if (x.log_cos_retro > -3 || y.log_cos_retro > -3) CHECK(x.log_cos_retro == Approx(y.log_cos_retro).epsilon(1e-11).margin(1e-13));
    const bool same = y.cos_d == z.cos_d && y.beta_gap == z.beta_gap && y.slope_x == z.slope_x && y.slope_y == z.slope_y &&
                      y.product_x == z.product_x && y.product_y == z.product_y && y.log_cos_retro == z.log_cos_retro;
    CHECK(same);
  }
}

TEST_CASE("the retro-reflection angle keeps its digits near 0") {
  const double offset_deg = 1e-6, rad = offset_deg * 3.14159265358979323846 / 180;
  const LobeGeometry g = lobe_geometry(GonioAngles{40_deg, 10_deg, degrees(40 + offset_deg), 10_deg});
  CHECK(g.log_cos_retro == Approx(-rad * rad / 2).epsilon(1e-7));
}
