// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/fitted_model.hpp"

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("The lobe of the data is found, and without one the diffuse part alone") {
  const auto angles = polar_grid({20, 40, 60}, 5, 10);
  const auto sharp = fitted_model(readings(lobe("blinn-phong", .3, .2, 100), angles, percent, 1));
  REQUIRE(sharp);
  CHECK(sharp->values()[0][2] == Approx(100).epsilon(.02));
  const auto flat = fitted_model(readings(AnalyticBrdf("lambert", single_channel("Y"), {{.4}}), angles, percent, 1));
  REQUIRE(flat);
  CHECK(flat->eval(angles[0])[0] == Approx(.4 / 3.14159).epsilon(.01));
}

TEST_CASE("A lobe that the samples do not resolve is not built on") {
  CHECK(!fitted_model(readings(lobe("blinn-phong", .1, .5, 1e5), polar_grid({20}, 10, 15), percent, 1)));
  CHECK(!fitted_model(std::make_shared<Dataset>()));
}
