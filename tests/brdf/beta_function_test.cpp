// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/beta_function.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("the gamma ratio is right at known points and obeys its recurrence") {
  constexpr double rounding_only = 3e-15;
  CHECK(gamma_ratio_half(0.0) == Approx(std::sqrt(std::numbers::pi)).epsilon(rounding_only));
  CHECK(gamma_ratio_half(0.5) == Approx(2 / std::sqrt(std::numbers::pi)).epsilon(rounding_only));
  for (const double z : {0.1, 3.0, 49.5, 50.5, 1e3, 1e9})
    CHECK(gamma_ratio_half(z) == Approx(gamma_ratio_half(z + 1) * (z + 1) / (z + 0.5)).epsilon(rounding_only));
}

TEST_CASE("the gamma ratio stays exact where the difference of lgamma does not") {
  const double z = 1e9, naive = std::exp(std::lgamma(z + 0.5) - std::lgamma(z + 1));
  const double leading = (1 - 1 / (8 * z)) / std::sqrt(z);
  CHECK(gamma_ratio_half(z) == Approx(leading).epsilon(1e-15));
  CHECK(std::fabs(naive / leading - 1) > 1e-9);
}

TEST_CASE("the incomplete beta function has its closed forms and its symmetry point") {
  constexpr double rounding_only = 1e-14;
  // I_x(1/2, 1) = sqrt x
  for (const double x : {1e-12, 0.2, 0.5, 0.8, 1 - 1e-9})
    CHECK(incomplete_beta_half(x, 1 - x, 1) == Approx(std::sqrt(x)).epsilon(rounding_only));
  // I_x(1/2, 2) = sqrt x (3 - x)/2
  for (const double x : {1e-6, 0.3, 0.7, 0.999})
    CHECK(incomplete_beta_half(x, 1 - x, 2) == Approx(std::sqrt(x) * (3 - x) / 2).epsilon(rounding_only));
  CHECK(incomplete_beta_half(0, 1, 5) == 0);
  CHECK(incomplete_beta_half(1, 0, 5) == 1);
  // for large b it tends to erf(sqrt(b x))
  CHECK(incomplete_beta_half(1e-9, 1 - 1e-9, 1e9) == Approx(std::erf(1.0)).epsilon(1e-8));
}
