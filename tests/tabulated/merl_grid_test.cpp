// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/merl_grid.hpp"

#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

HalfDifference through_directions(const HalfDifference& coordinates) {
  const DirectionPair pair = directions(coordinates);
  return half_difference(pair.wi, pair.wo);
}

}  // namespace

TEST_CASE("Index and cell are each other's inverse over the whole grid") {
  std::size_t wrong = 0;
  for (std::size_t index = 0; index < MerlGrid::cell_count; ++index) wrong += MerlGrid::index(MerlGrid::cell(index)) != index;
  CHECK(wrong == 0);
  CHECK(MerlGrid::index({89, 89, 179}) == MerlGrid::cell_count - 1);
  CHECK(MerlGrid::index({1, 2, 3}) == 3 + 180 * (2 + 90 * 1));
}

TEST_CASE("theta_h is spaced by its square root, the other two evenly") {
  CHECK(MerlGrid::node({0, 0, 0}, MerlNodes::left).theta_h.degrees() == 0);
  CHECK(MerlGrid::node({30, 80, 90}, MerlNodes::left).theta_h.degrees() == 10);
  CHECK(MerlGrid::node({30, 80, 90}, MerlNodes::left).theta_d.degrees() == 80);
  CHECK(MerlGrid::node({30, 80, 90}, MerlNodes::centre).theta_h.degrees() == 30.5 * 30.5 / 90);
  CHECK(MerlGrid::node({30, 80, 90}, MerlNodes::centre).phi_d.degrees() == 90.5);
}

TEST_CASE("Every node goes to directions and back to itself") {
  // At theta_h = 0 or theta_d = 0 phi_d has no meaning; elsewhere all three positions come back as integers.
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    std::size_t wrong = 0;
    for (std::size_t index = 0; index < MerlGrid::cell_count; ++index) {
      const MerlCell cell = MerlGrid::cell(index);
      const HalfDifference node = MerlGrid::node(cell, nodes);
      const MerlGrid::Position at = MerlGrid::position(through_directions(node), nodes);
      const bool has_phi_d = node.theta_h.radians() > 0 && node.theta_d.radians() > 0;
      double phi_d = at.phi_d;
      if (phi_d == 180) phi_d = 0;  // just below a half turn is the first node again
      wrong += at.theta_h != static_cast<double>(cell.theta_h) || at.theta_d != static_cast<double>(cell.theta_d) ||
               (has_phi_d && phi_d != static_cast<double>(cell.phi_d));
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("Every centre lies in its cell") {
  std::size_t wrong = 0;
  for (std::size_t index = 0; index < MerlGrid::cell_count; ++index)
    wrong += MerlGrid::cell_of(through_directions(MerlGrid::node(MerlGrid::cell(index), MerlNodes::centre))) != MerlGrid::cell(index);
  CHECK(wrong == 0);
}

TEST_CASE("No draw inside a cell falls into another, the exchanged pair included") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  constexpr int draws = 20000;
  // Of a cell: closer to an edge rounding decides, and may. Near theta_h = 0 the rounding of the vectors, 1e-16, turns phi_d by
  // 1e-16 / theta_h: at a hundredth of the first cell that is less than a millionth of a cell of phi_d.
  constexpr double edge = 1e-6, pole = 1e-2;
  const MerlCell cells[] = {{0, 0, 0}, {0, 89, 179}, {1, 45, 90}, {45, 1, 0}, {45, 45, 179}, {89, 0, 17}, {89, 89, 90}};
  for (const MerlCell& cell : cells) {
    int wrong = 0;
    for (int k = 0; k < draws; ++k) {
      const auto within = [&](std::size_t low) { return static_cast<double>(low) + test::uniform(random, edge, 1 - edge); };
      const double h = cell.theta_h == 0 ? test::uniform(random, pole, 1 - edge) : within(cell.theta_h);
      const HalfDifference drawn{degrees(h * h / 90), degrees(test::uniform(random, -180, 180)), degrees(within(cell.theta_d)),
                                 degrees(within(cell.phi_d))};
      const DirectionPair pair = directions(drawn);
      wrong += MerlGrid::cell_of(half_difference(pair.wi, pair.wo)) != cell;
      wrong += MerlGrid::cell_of(half_difference(pair.wo, pair.wi)) != cell;
    }
    CAPTURE(cell.theta_h, cell.theta_d, cell.phi_d);
    CHECK(wrong == 0);
  }
}

TEST_CASE("A node exactly on the horizon is below it") {
  // theta_h = 10°, theta_d = 80°, phi_d = 0: wi lies in the surface.
  CHECK_FALSE(above_horizon(directions(MerlGrid::node({30, 80, 0}, MerlNodes::left))));
  CHECK(above_horizon(directions(MerlGrid::node({30, 79, 0}, MerlNodes::left))));
}
