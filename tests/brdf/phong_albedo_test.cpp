// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/phong_albedo.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("the Phong albedo is 1 at the normal, falls, and ends at 1/sqrt(2 pi s)") {
  for (const double s : {0.0, 0.3, 7.0, 1e3, 1e6, 1e9}) {
    INFO("s = " << s);
    CHECK(phong_albedo(s, 0_deg) == Approx(1).epsilon(1e-14));
    double previous = 1 + 1e-12;
    bool falls = true;
    for (double theta = 1; theta <= 90; theta += 1) {
      const double albedo = phong_albedo(s, degrees(theta));
      falls = falls && albedo <= previous;
      previous = albedo;
    }
    CHECK(falls);
    if (s > 1e5) CHECK(previous == Approx(1 / std::sqrt(2 * std::numbers::pi * s)).epsilon(1e-5));
  }
  CHECK(phong_albedo(0, 60_deg) == Approx(0.75));
}
