// SPDX-License-Identifier: BSD-3-Clause
// The ABC models evaluate published parameters.
#include "brdf/models/abc.hpp"

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

/// F as written in the paper of Cook and Torrance.
double fresnel(double c, double n) {
  const double g = std::sqrt(n * n + c * c - 1);
  return 0.5 * std::pow((g - c) / (g + c), 2) * (1 + std::pow((c * (g + c) - 1) / (c * (g - c) + 1), 2));
}

}  // namespace

TEST_CASE("the ABC models are the published formulas") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  // alum-bronze, red (Low et al. 2012, supplemental material): smooth and microfacet, the latter listed with its factor pi.
  const AnalyticBrdf smooth("abc", single_channel("r"), {{0.0096, 164.16745, 16711.814477, 0.663506, 1.56082}});
  const AnalyticBrdf rough("abc-microfacet", single_channel("r"), {{0.024514, 51.714554 / pi, 10482.133789, 0.816737, 2.236525}});
  for (int k = 0; k < 500; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), length = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double ch = hz / length, cd = length / 2, dx = wi.x() - wo.x(), dy = wi.y() - wo.y();
    const double mirror = std::sqrt(1 - (dx * dx + dy * dy) / 4);
    CHECK(smooth.eval(wi, wo)[0] ==
          Approx(0.0096 / pi + 164.16745 * fresnel(mirror, 1.56082) * std::pow(1 + 16711.814477 * (hx * hx + hy * hy), -0.663506))
              .epsilon(1e-10));
    const double g = std::min({1.0, 2 * ch * wi.z() / cd, 2 * ch * wo.z() / cd});
    CHECK(rough.eval(wi, wo)[0] == Approx(0.024514 / pi + 51.714554 / pi * fresnel(cd, 2.236525) * g / (wi.z() * wo.z()) *
                                                              std::pow(1 + 10482.133789 * (1 - ch), -0.816737))
                                       .epsilon(1e-9));
  }
}
