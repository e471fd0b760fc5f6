// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/paired_places.hpp"

#include <cmath>

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

Contrasts pairs_of(const std::vector<std::shared_ptr<const Dataset>>& datasets) {
  Contrasts set;
  set.pattern_names = {"cosines", "time"};
  set.pattern_share = {.5, .1};
  add_pairs(
      datasets, {key_of, exchanged},
      [](const GonioAngles& a, double time) {
        return std::vector<double>{a.theta_i.cos() - a.theta_o.cos(), time};
      },
      set);
  return set;
}

std::shared_ptr<Dataset> two_exchanged() {
  auto data = sweep({{degrees(10), degrees(0), degrees(50), degrees(180)},
                     {degrees(50), degrees(180), degrees(10), degrees(0)},
                     {degrees(50), degrees(180), degrees(10), degrees(0)}},
                    percent, 1);
  data->f[0] = {1, 2, 4};
  data->u[0] = {.1, .3, .4};
  data->extra["time_s"] = {10, 20, 30};
  return data;
}

}  // namespace

TEST_CASE("A pair is one contrast: repeats are averaged, patterns take their difference, the scale is the mean") {
  const Contrasts set = pairs_of({two_exchanged()});
  REQUIRE(set.contrasts.size() == 1);
  const Contrast& c = set.contrasts[0];
  CHECK(c.mean == 2);
  CHECK(c.scale == 2);
  CHECK(c.pattern[0] == Approx(2 * 2 * (std::cos(10 * 3.14159265358979 / 180) - std::cos(50 * 3.14159265358979 / 180))));
  CHECK(c.pattern[1] == Approx(2 * (0 - .5)));
  CHECK(set.readings[c.terms[1].reading].f == 3);
  CHECK(set.readings[c.terms[1].reading].u == Approx(.25));
  CHECK(c.terms[0].weight == -c.terms[1].weight);
}

TEST_CASE("Shared components of several data sets stand side by side, and pairs never cross data sets") {
  auto one = two_exchanged(), other = two_exchanged();
  one->correlated = {{"scale", .1, {}}};
  other->correlated = {{"scale", .2, {}}, {"drift", .1, {0, 1, 2}}};
  const Contrasts set = pairs_of({one, other});
  REQUIRE(set.contrasts.size() == 2);
  CHECK(set.readings[set.contrasts[0].terms[0].reading].shared == std::vector<double>{.1, 0, 0});
  CHECK(set.readings[set.contrasts[1].terms[0].reading].shared == std::vector<double>{0, .2, 0});
  CHECK(set.contrasts[0].place != set.contrasts[1].place);
}

TEST_CASE("The mirror image keeps wi and the zenith angle of wo") {
  const GonioAngles a{degrees(20), degrees(33), degrees(50), degrees(73)}, m = mirrored(a);
  CHECK(m.phi_o.degrees() == -7);
  CHECK(m.theta_o.degrees() == 50);
  CHECK(mirrored(m).phi_o.degrees() == 73);
}
