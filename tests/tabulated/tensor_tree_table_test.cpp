// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/tensor_tree_table.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Positions in the cube give the directions back, from either side of the sheet") {
  test::Random random(test::seed);
  for (const double sign : {1.0, -1.0})
    for (const std::size_t dimensions : {3u, 4u})
      for (int k = 0; k < 3000; ++k) {
        TensorTree::Position at{test::uniform(random, 0, dimensions == 3 ? 0.499 : 1), test::uniform(random, 0, 1),
                                test::uniform(random, 0, 1), dimensions == 4 ? test::uniform(random, 0, 1) : 0};
        const DirectionPair pair = tree_directions(dimensions, at, sign);
        const TensorTree::Position back = tree_position(dimensions, pair.wi, pair.wo, sign);
        for (std::size_t i = 0; i < dimensions; ++i) CHECK(std::fabs(back[i] - at[i]) < 1e-12);
      }
}

TEST_CASE("Rank 3 looks at the difference of azimuths only; mirror directions lie on the positive x axis") {
  const auto wi = Direction::spherical(40_deg, 70_deg), wo = Direction::spherical(40_deg, 250_deg);
  const TensorTree::Position at = tree_position(3, wi, wo, 1);
  CHECK(at[0] == Approx(0.5 - 0.5 * std::sin(40 * 3.14159265358979312 / 180)));
  CHECK(at[1] == Approx(0.5 + 0.5 * std::sin(40 * 3.14159265358979312 / 180)));
  CHECK(at[2] == Approx(0.5));
  const TensorTree::Position turned = tree_position(3, Direction::spherical(40_deg, -20_deg), Direction::spherical(40_deg, 160_deg), 1);
  for (std::size_t i = 0; i < 3; ++i) CHECK(turned[i] == Approx(at[i]));
  CHECK(tree_position(3, Direction(), Direction(), 1)[0] < 0.5);
}

TEST_CASE("Colour comes out of Y, u' and v'; below the horizon is 0, and transmission lies below it") {
  const TensorTreeTable table({TensorTree(3, 0.5f), TensorTree(3, 4.0f / 19), TensorTree(3, 9.0f / 19)}, {});  // white of equal energy
  CHECK(table.symmetry().isotropic);
  const auto f = table.eval(Direction(), Direction::spherical(30_deg, 20_deg));
  REQUIRE(f.size() == 3);
  for (const double value : f) CHECK(value == Approx(0.5).epsilon(1e-6));
  CHECK(table.eval(Direction(), Direction::spherical(150_deg, 20_deg))[0] == 0);
  const TensorTreeTable through({TensorTree(3, 0.5f), {}, {}}, {Side::transmission, false});
  CHECK(through.channels()[0].name == "Y");
  CHECK(through.eval(Direction(), Direction::spherical(30_deg, 20_deg))[0] == 0);
  CHECK(through.eval(Direction(), Direction::spherical(150_deg, 20_deg))[0] == 0.5);
  const Dataset samples = through.samples();
  REQUIRE(samples.size() == 1);
  CHECK(samples.angles[0].theta_o.degrees() > 90);
  CHECK(samples.f[0][0] == 0.5);
}
