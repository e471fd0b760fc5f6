// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/total_scatter.hpp"

#include <cmath>

#include "brdf/analytic_brdf.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("A perfect Lambert surface scatters everything at every incidence") {
  const AnalyticBrdf white("lambert", single_channel("value"), {{1.0}});
  for (const double theta : {0.0, 30.0, 60.0, 80.0, 85.0, 89.0}) {
    INFO("incidence " << theta);
    CHECK(std::fabs(total_scatter(white, degrees(theta), 40_deg, Side::reflection)[0] - 1) < 1e-3);
  }
}

TEST_CASE("Lobes give the directional albedo of the model, narrow ones too") {
  for (const double s : {10.0, 1000.0, 1e5}) {
    const AnalyticBrdf model("blinn-phong", rgb_channels(), {{0.1, 0.3, s}, {0.2, 0.2, s}, {0.3, 0.1, s}});
    for (const double theta : {0.0, 45.0, 80.0}) {
      const auto ours = total_scatter(model, degrees(theta), 0_deg, Side::reflection), exact = model.directional_albedo(degrees(theta));
      for (std::size_t c = 0; c < 3; ++c) {
        INFO("s " << s << " incidence " << theta << " channel " << c);
        CHECK(std::fabs(ours[c] - exact[c]) < 2e-3 * exact[c]);
      }
    }
  }
}
