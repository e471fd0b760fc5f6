// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/blinn_phong_albedo.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE("the half-vector lobe integral has its closed forms at both ends") {
  constexpr double rounding_only = 1e-13;
  for (const double s : {0.0, 1e-3, 2.0, 8.764, 1e3, 1e6, 1e9}) {
    CHECK(half_vector_lobe_integral(s, 0_deg) == Approx(8 * pi * (std::exp2(-s / 2) + s) / ((s + 2) * (s + 4))).epsilon(rounding_only));
    CHECK(half_vector_lobe_integral(s, 90_deg) == Approx(8 * pi / ((s + 2) * (s + 4))).epsilon(rounding_only));
  }
}

TEST_CASE("the customary normalisation over-reflects by 7.5 % at s = 8.764") {
  double largest = 0, at = 0;
  for (double s = 0; s < 40; s += 0.001) {
    const double albedo = blinn_phong_norm(s) / blinn_phong_exact_norm(s);
    if (albedo > largest) largest = albedo, at = s;
  }
  CHECK(largest == Approx(1.0752011615).epsilon(1e-9));
  CHECK(at == Approx(8.764).margin(0.001));
}

TEST_CASE("the integral is continuous to grazing for sharp and for flat lobes") {
  for (const double s : {1e-3, 10.0, 1e6, 1e9}) {
    // Between 89.99999° and 90° nothing but the limit can happen: the slope in cos θ is at most of order 1.
    const double near = half_vector_lobe_integral(s, 89.99999_deg), end = half_vector_lobe_integral(s, 90_deg);
    CHECK(std::fabs(near - end) < 1e-6);
    CHECK(std::isfinite(near));
  }
}
