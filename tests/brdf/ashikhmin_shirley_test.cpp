// SPDX-License-Identifier: BSD-3-Clause
// Ashikhmin and Shirley's lobe against the formula of the paper.
#include "brdf/models/ashikhmin_shirley_anisotropic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("Ashikhmin-Shirley is the formula of the paper, and with equal exponents the isotropic lobe") {
  constexpr double pi = std::numbers::pi;
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  const AnalyticBrdf two("ashikhmin-shirley-anisotropic", single_channel("Y"), {{0, 0.1, 0.8, 12, 3}});
  const AnalyticBrdf equal("ashikhmin-shirley-anisotropic", single_channel("Y"), {{0.2, 0.1, 0.8, 7, 7}}),
      one("ashikhmin-shirley", single_channel("Y"), {{0.2, 0.1, 0.8, 7}});
  for (int k = 0; k < 500; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), length = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double ch = hz / length, cd = length / 2, cos2_phi = hx * hx / (hx * hx + hy * hy);
    const double lobe =
        std::sqrt(13.0 * 4.0) / (8 * pi) * std::pow(ch, 12 * cos2_phi + 3 * (1 - cos2_phi)) / (cd * std::max(wi.z(), wo.z()));
    CHECK(two.eval(wi, wo)[0] == Approx(lobe * (0.1 + 0.7 * std::pow(1 - cd, 5))).epsilon(1e-11));
    CHECK(equal.eval(wi, wo)[0] == Approx(one.eval(wi, wo)[0]).epsilon(1e-12));
  }
}
