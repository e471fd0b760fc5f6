// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/local_interpolation.hpp"

#include <cmath>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

std::vector<GonioAngles> grid() { return polar_grid({10, 20, 30, 40, 50, 60}, 10, 15); }

double smooth(const GonioAngles& a) { return 1 + .3 * a.theta_i.cos() * a.theta_o.cos() + .2 * a.wo().x(); }

}  // namespace

TEST_CASE("A smooth function is interpolated to second order, turned with the plane of incidence") {
  const auto angles = grid();
  const LocalInterpolation interpolation(angles);
  for (const double turn : {0., 77.}) {
    const auto weights = interpolation.at({degrees(25), degrees(turn), degrees(35), degrees(100 + turn)});
    REQUIRE(weights);
    double value = 0, sum = 0;
    for (const auto& [node, weight] : *weights) value += weight * smooth(angles[node]), sum += weight;
    CHECK(sum == Approx(1).epsilon(1e-7));
    CHECK(value == Approx(smooth({degrees(25), degrees(0), degrees(35), degrees(100)})).epsilon(5e-3));
  }
}

TEST_CASE("A sample that is left out has no weight, and nothing is said outside the samples") {
  const auto angles = grid();
  const LocalInterpolation interpolation(angles);
  const auto weights = interpolation.at(angles[200], [](std::size_t node) { return node == 200; });
  REQUIRE(weights);
  for (const auto& [node, weight] : *weights) CHECK(node != 200);
  CHECK(!interpolation.at({degrees(89), degrees(0), degrees(30), degrees(0)}));
  CHECK(!LocalInterpolation({angles.begin(), angles.begin() + 3}).at(angles[1]));
}
