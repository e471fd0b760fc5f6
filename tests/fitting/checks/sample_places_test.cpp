// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/sample_places.hpp"

#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

TEST_CASE("Directions closer than the tolerance are one place, wherever the cells of the hash end") {
  Places places;
  for (int k = 0; k < 200; ++k) {
    const double theta = 0.37 * k, phi = 11.3 * k;
    const std::size_t first = places.add(key_of({degrees(theta), degrees(phi), degrees(20), degrees(3 * k)}));
    CHECK(places.add(key_of({degrees(theta + .007), degrees(phi), degrees(20.004), degrees(3 * k)})) == first);
    CHECK(places.find(key_of({degrees(theta + .1), degrees(phi), degrees(20), degrees(3 * k)})) != first);
  }
  CHECK(places.size() == 200);
}

TEST_CASE("Turned about the normal a pair is the same place, and exchanged twice it is itself") {
  const GonioAngles a{degrees(30), degrees(10), degrees(50), degrees(150)}, turned{degrees(30), degrees(200), degrees(50), degrees(340)};
  Places places;
  places.add(key_turned(a));
  CHECK(places.find(key_turned(turned)));
  CHECK(!places.find(key_turned({degrees(30), degrees(10), degrees(50), degrees(-130)})));
  CHECK(key_of(exchanged(exchanged(a))) == key_of(a));
}

TEST_CASE("At the normal the azimuths do not count") {
  Places places;
  places.add(key_turned({degrees(0), degrees(0), degrees(50), degrees(150)}));
  CHECK(places.find(key_turned({degrees(0), degrees(77), degrees(50), degrees(3)})));
}

TEST_CASE("The mean of a place carries noise and shared components") {
  Dataset data;
  data.channels = single_channel("Y");
  data.angles.resize(3);
  data.f = {{1, 3, std::nan("")}};
  data.u = {{.3, .4, .1}};
  data.correlated = {{"scale", .02, {}}, {"drift", .1, {0, 1, 2}}};
  const auto mean = mean_of(data, 0, {0, 1, 2});
  REQUIRE(mean);
  CHECK(mean->f == 2);
  CHECK(mean->u == Approx(.25));
  CHECK(mean->shared[0] == Approx(.04));
  CHECK(mean->shared[1] == Approx(.15));
  CHECK(!mean_of(data, 0, {2}));
}
