// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/quantity.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;
using tabulated::factor_to_f;

TEST_CASE("Every quantity becomes f by its own factor") {
  constexpr double rounding = 1e-15;
  CHECK(factor_to_f(Quantity::f, 60_deg) == 1);
  CHECK(std::fabs(factor_to_f(Quantity::f_cos, 60_deg) - 2) < rounding);
  CHECK(std::fabs(factor_to_f(Quantity::reflectance_factor, 60_deg) * std::numbers::pi - 1) < rounding);
  CHECK(std::fabs(factor_to_f(Quantity::signal_ratio, 60_deg) * std::numbers::pi - 2) < 2 * rounding);
}

TEST_CASE("A quantity with the cosine in it says nothing at the horizon") {
  CHECK(std::isnan(factor_to_f(Quantity::f_cos, 90_deg)));
  CHECK(std::isnan(factor_to_f(Quantity::signal_ratio, radians(std::numbers::pi / 2))));
  CHECK(factor_to_f(Quantity::f, 90_deg) == 1);
}
