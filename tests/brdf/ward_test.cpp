// SPDX-License-Identifier: BSD-3-Clause
// Special values of the four forms of Ward's lobe.
#include "brdf/models/ward.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

double of(const std::string& model, std::vector<double> values, const GonioAngles& angles) {
  return AnalyticBrdf(model, single_channel("Y"), {std::move(values)}).eval(angles)[0];
}

}  // namespace

TEST_CASE("every Ward lobe is rho_s/(4 pi alpha_x alpha_y) at the normal") {
  const GonioAngles normal{0_deg, 0_deg, 0_deg, 0_deg};
  for (const char* model : {"ward", "ward-duer-gm"})
    CHECK(of(model, {0, 0.5, 0.2}, normal) == Approx(0.5 / (4 * pi * 0.04)).epsilon(1e-14));
  for (const char* model : {"ward-anisotropic", "ward-duer-gm-anisotropic"})
    CHECK(of(model, {0, 0.5, 0.1, 0.4}, normal) == Approx(0.5 / (4 * pi * 0.04)).epsilon(1e-14));
}

TEST_CASE("Ward's lobe is the formula of the paper") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (int k = 0; k < 200; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), ax = 0.3, ay = 0.7;
    const double exponent = (hx * hx / (ax * ax) + hy * hy / (ay * ay)) / (hz * hz), gaussian = std::exp(-exponent) / (pi * ax * ay);
    CHECK(AnalyticBrdf("ward-anisotropic", single_channel("Y"), {{0, 1, ax, ay}}).eval(wi, wo)[0] ==
          Approx(gaussian / (4 * std::sqrt(wi.z() * wo.z()))).epsilon(1e-12));
    CHECK(AnalyticBrdf("ward-duer-gm-anisotropic", single_channel("Y"), {{0, 1, ax, ay}}).eval(wi, wo)[0] ==
          Approx(gaussian * (hx * hx + hy * hy + hz * hz) / std::pow(hz, 4)).epsilon(1e-12));
  }
}

TEST_CASE("with equal widths the anisotropic lobe is the isotropic one, and exchanged widths are a quarter turn") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (const std::string model : {"ward", "ward-duer-gm"})
    for (int k = 0; k < 200; ++k) {
      const GonioAngles a = test::gonio_pair(random);
      CHECK(of(model + "-anisotropic", {0.2, 1, 0.5, 0.5}, a) == Approx(of(model, {0.2, 1, 0.5}, a)).epsilon(1e-6));
      const GonioAngles turned{a.theta_i, a.phi_i + 90_deg, a.theta_o, a.phi_o + 90_deg};
      CHECK(of(model + "-anisotropic", {0.2, 1, 0.8, 0.4}, turned) ==
            Approx(of(model + "-anisotropic", {0.2, 1, 0.4, 0.8}, a)).epsilon(1e-6));
    }
}

TEST_CASE("at the horizon Ward's lobe takes a definite large value and the bounded one its limit") {
  const ModelInfo &ward = model_info("ward"), &bounded = model_info("ward-duer-gm");
  const LobeGeometry horizon = lobe_geometry(GonioAngles{90_deg, 0_deg, 30_deg, 180_deg}),
                     near = lobe_geometry(GonioAngles{89.9999_deg, 0_deg, 30_deg, 180_deg});
  const double alpha = 0.8;
  double at[2], beside[2];
  ward.basis(std::span(&horizon, 1), &alpha, at, 1);
  CHECK(at[1] == Approx(std::exp(-horizon.tan2_h / 0.64) / (4 * pi * 0.64) * 1e4).epsilon(1e-10));
  bounded.basis(std::span(&horizon, 1), &alpha, at, 1);
  bounded.basis(std::span(&near, 1), &alpha, beside, 1);
  CHECK(at[1] == Approx(beside[1]).epsilon(1e-5));
}
