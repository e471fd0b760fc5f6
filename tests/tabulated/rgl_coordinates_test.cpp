// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgl_coordinates.hpp"

#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using tabulated::find_coordinates, tabulated::RglPairs;

TEST_CASE("Zenith angles and azimuths are those of the library's arc tangent to 1e-11, grazing and at the normal too") {
  constexpr double pi = std::numbers::pi, tolerance = 1e-11;
  test::Random random(test::seed);
  RglPairs pairs{};
  for (int round = 0; round < 200; ++round)
    for (const bool relative : {true, false}) {
      for (std::size_t k = 0; k < RglPairs::most; ++k) {
        const GonioAngles angles = test::gonio_pair(random);
        const Direction i = k == 0 ? Direction{} : angles.wi(), o = angles.wo();
        pairs.ix[k] = i.x(), pairs.iy[k] = i.y(), pairs.iz[k] = i.z();
        pairs.ox[k] = o.x(), pairs.oy[k] = o.y(), pairs.oz[k] = o.z();
      }
      pairs.count = RglPairs::most;
      find_coordinates(pairs, relative);
      INFO("seed " << test::seed << ", round " << round);
      for (std::size_t k = 0; k < RglPairs::most; ++k) {
        const double theta_i = std::atan2(std::hypot(pairs.ix[k], pairs.iy[k]), pairs.iz[k]);
        const double phi_i = std::atan2(pairs.iy[k], pairs.ix[k]);
        const double hx = pairs.ix[k] + pairs.ox[k], hy = pairs.iy[k] + pairs.oy[k], hz = pairs.iz[k] + pairs.oz[k];
        const double theta_h = std::atan2(std::hypot(hx, hy), hz), phi_h = std::atan2(hy, hx);
        CHECK(std::fabs(pairs.theta_i[k] - theta_i) < tolerance);
        CHECK(std::fabs(pairs.turn_i[k] - phi_i / (2 * pi)) < tolerance);
        CHECK(std::fabs(pairs.incident_x[k] * pairs.incident_x[k] * pi / 2 - theta_i) < tolerance);
        CHECK(std::fabs(pairs.half_x[k] * pairs.half_x[k] * pi / 2 - theta_h) < tolerance);
        const double turns = (phi_h - (relative ? phi_i : 0)) / (2 * pi) + 0.5;
        CHECK(std::fabs(std::remainder(pairs.half_y[k] - turns, 1.0)) < tolerance * (1 + 1e-4 / std::hypot(hx, hy)));
        CHECK(pairs.half_y[k] >= 0);
        CHECK(pairs.half_y[k] < 1);
      }
    }
}

TEST_CASE("A pair has the same coordinates wherever it stands in the batch") {
  test::Random random(test::seed);
  RglPairs pairs{}, turned{};
  for (std::size_t k = 0; k < RglPairs::most; ++k) {
    const Direction i = test::upper_direction(random), o = test::upper_direction(random);
    const std::size_t other = RglPairs::most - 1 - k;
    pairs.ix[k] = turned.ix[other] = i.x(), pairs.iy[k] = turned.iy[other] = i.y(), pairs.iz[k] = turned.iz[other] = i.z();
    pairs.ox[k] = turned.ox[other] = o.x(), pairs.oy[k] = turned.oy[other] = o.y(), pairs.oz[k] = turned.oz[other] = o.z();
  }
  pairs.count = turned.count = RglPairs::most;
  find_coordinates(pairs, true);
  find_coordinates(turned, true);
  for (std::size_t k = 0; k < RglPairs::most; ++k) {
    CHECK(pairs.half_x[k] == turned.half_x[RglPairs::most - 1 - k]);
    CHECK(pairs.half_y[k] == turned.half_y[RglPairs::most - 1 - k]);
    CHECK(pairs.theta_i[k] == turned.theta_i[RglPairs::most - 1 - k]);
  }
}
