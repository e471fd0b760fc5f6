// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/repeatability.hpp"

#include "fitting/checks/paired_places.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

std::shared_ptr<Dataset> without_u(const std::vector<GonioAngles>& angles, double noise, double side) {
  auto data = sweep(angles, {0, 0, noise}, 3, [&](const GonioAngles& a) { return 1 + side * ((a.phi_o - a.phi_i).sin() > 0 ? 1 : -1); });
  data->u.clear();
  return data;
}

}  // namespace

TEST_CASE("Repeats give the scatter of one reading; without them there is none") {
  auto angles = polar_grid({30}, 20, 30);
  const std::vector<GonioAngles> once = angles;
  for (int repeat = 0; repeat < 9; ++repeat) angles.insert(angles.end(), once.begin(), once.end());
  const auto found = repeated_readings({without_u(angles, .04, 0)});
  REQUIRE(found);
  CHECK(found->relative == Approx(.04).epsilon(.2));
  CHECK(found->n == once.size());
  CHECK(!repeated_readings({without_u(once, .04, 0)}));
}

TEST_CASE("The median effect has limits that hold it, and none from a handful of places") {
  const MedianEffect effect = median_effect(mirror_pairs({without_u(polar_grid({20, 40, 60}, 10, 15), .001, .05)}), .01);
  CHECK(effect.median == Approx(.1).epsilon(.05));
  CHECK(effect.lower < .1);
  CHECK(effect.upper > .1);
  CHECK(effect.rms == Approx(.1).epsilon(.05));
  CHECK(median_effect(mirror_pairs({without_u(polar_grid({20}, 40, 60), .001, .05)}), .01).upper == INFINITY);
}

TEST_CASE("Without u: within the margin passes, beyond it and beyond the repeats fails, anything else cannot tell") {
  const auto verdict = [](double noise, double side, std::optional<Repeatability> repeatability) {
    const auto data = without_u(polar_grid({20, 40, 60}, 10, 15), noise, side);
    Check check;
    judge_without_uncertainty(check, mirror_pairs({data}), repeatability, {{data}, nullptr, nullptr}, {}, "pairs");
    INFO(check.detail);
    CHECK(!check.p_value);
    return check.verdict;
  };
  CHECK(verdict(.003, 0, std::nullopt) == Verdict::pass);
  CHECK(verdict(.003, .1, Repeatability{.01, 10, "repeats"}) == Verdict::fail);
  CHECK(verdict(.003, .1, Repeatability{.3, 10, "repeats"}) == Verdict::vacuous);
  CHECK(verdict(.003, .1, std::nullopt) == Verdict::vacuous);
}
