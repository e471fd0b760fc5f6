// SPDX-License-Identifier: BSD-3-Clause
// The retro-reflecting lobes are the mirror-like ones with the light on the other side.
#include "brdf/models/retro_phong.hpp"

#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("a retro-reflecting lobe is the mirror-like one turned by half a turn") {
  struct Pair {
    const char *retro, *mirror;
  };
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (const Pair& pair : {Pair{"retro-phong", "phong"}, Pair{"retro-blinn-phong", "blinn-phong-exact"}})
    for (const double s : {0.0, 3.0, 200.0, 1e5}) {
      const AnalyticBrdf retro(pair.retro, single_channel("Y"), {{0.1, 0.5, s}}), mirror(pair.mirror, single_channel("Y"), {{0.1, 0.5, s}});
      INFO(pair.retro << " s=" << s);
      for (int k = 0; k < 200; ++k) {
        const GonioAngles a{degrees(test::uniform(random, 0, 89)), degrees(test::uniform(random, 0, 360)),
                            degrees(test::uniform(random, 0, 89)), degrees(test::uniform(random, 0, 360))};
        CHECK(retro.eval(a)[0] == Approx(mirror.eval({a.theta_i, a.phi_i, a.theta_o, a.phi_o + 180_deg})[0]).epsilon(1e-8));
      }
      const GonioAngles peak{70_deg, 10_deg, 70_deg, 10_deg};
      CHECK(retro.eval(peak)[0] == Approx(mirror.eval({70_deg, 10_deg, 70_deg, 190_deg})[0]).epsilon(1e-12));
      CHECK(retro.directional_albedo(40_deg)[0] == mirror.directional_albedo(40_deg)[0]);
    }
}
