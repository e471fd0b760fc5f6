// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lobe_quadrature.hpp"

#include <numbers>

#include "tests/tabulated/measured_model.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("The albedo of models from wide to narrow is within the promised part of the exact one") {
  for (const double s : {0.0, 5.0, 100.0, 1e4, 1e6})
    for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
      const AnalyticBrdf brdf = test::model("phong", {s == 0 ? 1.0 : 0.0, 1, s});
      const Direction wi = Direction::spherical(degrees(theta), 20_deg);
      double sum = 0;
      for (const LobeNode& node : lobe_quadrature(wi)) sum += node.weight * brdf.eval(wi, node.wo)[0];
      INFO("s " << s << " theta_i " << theta);
      CHECK(sum == Approx(brdf.directional_albedo(degrees(theta))[0]).epsilon(0.03));
    }
}
