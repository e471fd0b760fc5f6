// SPDX-License-Identifier: BSD-3-Clause
// Readings of the same directions are found whatever their order and however the pole is written.
#include "fitting/repeats.hpp"

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("samples of the same two directions belong together") {
  const std::vector<GonioAngles> angles{
      {degrees(10), degrees(0), degrees(20), degrees(30)},    {degrees(10), degrees(0), degrees(0), degrees(0)},
      {degrees(10), degrees(0), degrees(20.01), degrees(30)}, {degrees(10), degrees(0), degrees(20), degrees(390)},
      {degrees(10), degrees(0), degrees(0), degrees(77)},     {degrees(20), degrees(30), degrees(10), degrees(0)},
      {degrees(-10), degrees(180), degrees(20), degrees(30)}};
  const auto found = repeated_readings(*observe(readings(lobe("phong", .25, .4, 12), angles, {}, 1)));
  REQUIRE(found.size() == 2);
  CHECK(std::find(found.begin(), found.end(), RepeatedReadings{0, 3, 6}) != found.end());
  CHECK(std::find(found.begin(), found.end(), RepeatedReadings{1, 4}) != found.end());
}

TEST_CASE("a sweep without repeats has none") {
  CHECK(repeated_readings(*observe(readings(lobe("phong", .25, .4, 12), polar_grid({10, 40}, 10, 45), {}, 1))).empty());
}
