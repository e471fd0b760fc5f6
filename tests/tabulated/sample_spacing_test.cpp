// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/sample_spacing.hpp"

#include "tests/tabulated/measured_model.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::vector<PairPoint> points(const std::vector<GonioAngles>& angles) {
  std::vector<PairPoint> out;
  for (const GonioAngles& a : angles) out.push_back(pair_point(a.wi(), a.wo(), true));
  return out;
}

}  // namespace

TEST_CASE("A plan's own steps are found, in both directions") {
  const SampleSpacing spacing = sample_spacing(points(test::planned({})));
  CHECK(spacing.gridded);
  CHECK(spacing.incidences == 4);
  CHECK(spacing.s == Approx(0.08).margin(0.01));  // 5° of elevation, a little less at grazing
  CHECK(spacing.t == Approx(0.33).margin(0.03));  // 20° of incidence
}

TEST_CASE("Poses that miss their plan by a tenth of a degree still share their incidences; scattered samples do not") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  auto angles = test::planned({});
  for (GonioAngles& a : angles) a.theta_i = degrees(a.theta_i.degrees() + test::uniform(random, -0.1, 0.1));
  CHECK(sample_spacing(points(angles)).incidences == 4);
  const SampleSpacing scattered = sample_spacing(points(test::scattered(2000, random)));
  CHECK(!scattered.gridded);
  CHECK(scattered.s == scattered.t);
}

TEST_CASE("A single sample and a single incidence have steps too") {
  CHECK(sample_spacing(points({{10_deg, 0_deg, 20_deg, 0_deg}})).s > 0);
  test::Plan plan;
  plan.theta_i = {30};
  CHECK(sample_spacing(points(test::planned(plan))).t > 0);
}
