// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lazy_observations.hpp"

#include "tests/tabulated/one_channel.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Samples are made once, and not before somebody wants them") {
  int made = 0;
  const Symmetry isotropic{.isotropic = true};
  const LazyObservations lazy(single_channel("value"), isotropic, [&] {
    ++made;
    return test::one_channel({{30_deg, 0_deg, 40_deg, 180_deg}, {30_deg, 0_deg, 50_deg, 90_deg}}, {0.25, 0.5});
  });
  CHECK(lazy.channels().size() == 1);
  CHECK(lazy.symmetry() == isotropic);
  CHECK(made == 0);
  REQUIRE(lazy.block_count() == 1);
  const ObservationBlock block = lazy.block(0);
  CHECK(made == 1);
  REQUIRE(block.size == 2);
  CHECK(block.f[0][1] == 0.5);
  std::vector<GonioAngles> angles;
  lazy.angles(0, angles);
  REQUIRE(angles.size() == 2);
  CHECK(angles[1].phi_o.degrees() == Approx(90));
  CHECK(made == 1);
}
