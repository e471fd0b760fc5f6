// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/disk_square.hpp"

#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Disk to square and back is the same point, and the other way round") {
  test::Random random(test::seed);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const double u = test::uniform(random, 0, 1), v = test::uniform(random, 0, 1);
    const auto disk = disk_of_square(u, v);
    CHECK(std::hypot(disk[0], disk[1]) <= 1 + 1e-15);
    const auto square = square_of_disk(disk[0], disk[1]);
    worst = std::max({worst, std::fabs(square[0] - u), std::fabs(square[1] - v)});
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("The map keeps areas: the Jacobian is pi everywhere") {
  // d(disk)/d(square), by central differences away from the diagonals, where the derivative jumps.
  test::Random random(test::seed);
  constexpr double step = 1e-5;
  for (int k = 0; k < 2000; ++k) {
    const double u = test::uniform(random, 0.001, 0.999), v = test::uniform(random, 0.001, 0.999);
    if (std::fabs(std::fabs(u - 0.5) - std::fabs(v - 0.5)) < 2 * step) continue;
    const auto du1 = disk_of_square(u + step, v), du0 = disk_of_square(u - step, v);
    const auto dv1 = disk_of_square(u, v + step), dv0 = disk_of_square(u, v - step);
    const double jacobian = ((du1[0] - du0[0]) * (dv1[1] - dv0[1]) - (du1[1] - du0[1]) * (dv1[0] - dv0[0])) / (4 * step * step);
    CHECK(std::fabs(jacobian - std::numbers::pi) < 1e-6);
  }
}

TEST_CASE("Points whose place is known: centre, middles of the sides, corners") {
  CHECK(square_of_disk(0, 0) == std::array{0.5, 0.5});
  CHECK(disk_of_square(0.5, 0.5) == std::array{0.0, 0.0});
  CHECK(square_of_disk(1, 0) == std::array{1.0, 0.5});
  CHECK(square_of_disk(0, 1) == std::array{0.5, 1.0});
  CHECK(square_of_disk(-1, 0) == std::array{0.0, 0.5});
  CHECK(square_of_disk(0, -1) == std::array{0.5, 0.0});
  const auto corner = disk_of_square(1, 1);
  CHECK(corner[0] == Approx(std::numbers::sqrt2 / 2));
  CHECK(corner[1] == Approx(std::numbers::sqrt2 / 2));
  const auto opposite = disk_of_square(0, 1);
  CHECK(opposite[0] == Approx(-std::numbers::sqrt2 / 2));
  CHECK(opposite[1] == Approx(std::numbers::sqrt2 / 2));
}
