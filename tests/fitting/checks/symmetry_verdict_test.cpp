// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/symmetry_verdict.hpp"

#include <cmath>
#include <numbers>

#include "fitting/checks/paired_places.hpp"
#include "fitting/checks/tilt.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

Check verdict_of(const std::shared_ptr<const Dataset>& data) {
  Check check;
  judge_symmetry(check, mirror_pairs({data}), std::nullopt, {{data}, nullptr, nullptr}, {},
                 {"the symmetry", "pairs", "difference", "chi²/n", ": advice"});
  return check;
}

}  // namespace

TEST_CASE("The sentence names what was tested, the excess, the pattern and how many places stand out") {
  const Check check = verdict_of(sweep(polar_grid({20, 50}, 10, 15), percent, 5,
                                       [](const GonioAngles& a) { return 1 + .1 * a.theta_o.sin() * (a.phi_o - a.phi_i).sin(); }));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(check.detail.starts_with("pairs: difference beyond noise"));
  CHECK(check.detail.find("it goes with the side of the plane of incidence: advice") != std::string::npos);
  CHECK(check.detail.find("places stand out") != std::string::npos);
  REQUIRE(!check.where.empty());
  CHECK(check.where.size() <= CheckOptions{}.where);
  for (std::size_t k = 1; k < check.where.size(); ++k) CHECK(*check.where[k].p_holm >= *check.where[k - 1].p_holm);
}

TEST_CASE("A sideways tilt before a sharp lobe is called a tilt for mirror pairs too") {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, 2000);
  const auto angles = polar_grid({20, 40}, 2, 4);
  auto data = readings(truth, angles, percent, 3);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double ratio =
        truth.eval(seen_by_tilted(angles[k], TiltFrame::sample, 0, .1 * std::numbers::pi / 180))[0] / truth.eval(angles[k])[0];
    data->f[0][k] *= ratio, data->u[0][k] *= ratio;
  }
  const Check check = verdict_of(data);
  INFO(check.detail);
  CHECK(check.verdict == Verdict::warn);
  CHECK(check.detail.find("not a violation of the symmetry") != std::string::npos);
}
