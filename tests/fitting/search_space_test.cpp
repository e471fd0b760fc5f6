// SPDX-License-Identifier: BSD-3-Clause
// The axes of a search follow the model's table and the caller's wishes; equal terms stand in order.
#include "fitting/search_space.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

const double none = std::nan("");
const Wanted free_one{none, none, none};

}  // namespace

TEST_CASE("equal terms are put in order, the broad lobe first, their linear parameters along with them") {
  const ModelKernel kernel = model_kernel("blinn-phong+blinn-phong");
  const SearchSpace space(kernel, {free_one, free_one}, {true, true});
  REQUIRE(space.has_equal_terms());
  CHECK(space.ordered(std::vector<double>{10, 100}));
  CHECK(!space.ordered(std::vector<double>{100, 10}));
  std::vector<double> theta{100, 10};
  std::vector<std::vector<double>> linear{{.1, .2, .3}, {.4, .5, .6}};
  space.order(theta, linear);
  CHECK(theta == std::vector<double>{10, 100});
  CHECK(linear == std::vector<std::vector<double>>{{.1, .3, .2}, {.4, .6, .5}});
}

TEST_CASE("a roughness orders the other way round: the rougher lobe is the broad one") {
  const ModelKernel kernel = model_kernel("ward+ward");
  const SearchSpace space(kernel, {free_one, free_one}, {true, true});
  CHECK(space.ordered(std::vector<double>{.5, .05}));
  CHECK(!space.ordered(std::vector<double>{.05, .5}));
}

TEST_CASE("terms that are told apart by the model, a bound or a fixed value keep their places") {
  const ModelKernel equal = model_kernel("blinn-phong+blinn-phong"), other = model_kernel("blinn-phong+phong");
  CHECK(!SearchSpace(other, {free_one, free_one}, {true, true}).has_equal_terms());
  CHECK(!SearchSpace(equal, {{none, 1, 50}, free_one}, {true, true}).has_equal_terms());
  CHECK(!SearchSpace(equal, {{20, none, none}, free_one}, {true, true}).has_equal_terms());
  CHECK(!SearchSpace(equal, {free_one, free_one}, {true, false}).has_equal_terms());
}

TEST_CASE("held parameters leave the space, bounds cut it, and coordinates go there and back") {
  const ModelKernel kernel = model_kernel("blinn-phong+blinn-phong");
  const SearchSpace space(kernel, {{20, none, none}, {none, 5, 500}}, {true, true});
  REQUIRE(space.dimension() == 1);
  CHECK(space.axes()[0].parameter == 1);
  CHECK(space.axes()[0].low == Approx(std::log(5)));
  CHECK(space.axes()[0].high == Approx(std::log(500)));
  const std::vector<double> theta = space.theta(std::vector<double>{std::log(60)});
  CHECK(theta[0] == 20);
  CHECK(theta[1] == Approx(60));
  CHECK(space.coordinates(theta)[0] == Approx(std::log(60)));
}
