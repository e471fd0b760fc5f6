// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/interpolation_error.hpp"

#include "tests/tabulated/measured_model.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("The misses of noisy samples of the guide itself are put down to the noise, known or not") {
  INFO("seed " << test::seed);
  const AnalyticBrdf truth = test::model("blinn-phong", {0.2, 0.3, 50});
  for (const bool stated : {true, false}) {
    test::Random random(test::seed);
    const GuidedSamples samples =
        guided_samples(*test::measured(truth, test::planned({}), test::Noise{0.01, 1e-6, stated}, random), &truth);
    const InterpolationError error = estimate_interpolation_error(samples, 2);
    CHECK(error.n_left_out > 100);
    CHECK(error.rms == Approx(0.011).epsilon(0.25));  // the noise of the sample and, through the weights, of its neighbours
    if (!stated) CHECK(std::sqrt(error.noise[0]) == Approx(0.01).epsilon(0.25));
    if (stated) CHECK(error.noise[0] == 0);
  }
}

TEST_CASE("A worse guide leaves larger errors of interpolation") {
  test::Random random(test::seed);
  const AnalyticBrdf truth = test::model("blinn-phong", {0.2, 0.3, 50}), near = test::model("blinn-phong", {0.2, 0.3, 52}),
                     far = test::model("blinn-phong", {0.2, 0.3, 80});
  const auto data = test::measured(truth, test::planned({}), std::nullopt, random);
  const double near_rms = estimate_interpolation_error(guided_samples(*data, &near), 2).rms;
  CHECK(estimate_interpolation_error(guided_samples(*data, &far), 2).rms > 3 * near_rms);
  CHECK(estimate_interpolation_error(guided_samples(*data, nullptr), 2).rms > 10 * near_rms);
}

TEST_CASE("The estimate does not depend on the number of threads, and a few samples leave one") {
  test::Random random(test::seed);
  const AnalyticBrdf truth = test::model("blinn-phong", {0.2, 0.3, 50});
  const GuidedSamples samples = guided_samples(*test::measured(truth, test::planned({}), test::Noise{}, random), nullptr);
  const InterpolationError one = estimate_interpolation_error(samples, 1), three = estimate_interpolation_error(samples, 3);
  CHECK(one.variance == three.variance);
  CHECK(one.rms == three.rms);
  const GuidedSamples few =
      guided_samples(*test::measured(truth, {{10_deg, 0_deg, 10_deg, 0_deg}, {10_deg, 0_deg, 20_deg, 0_deg}}, {}, random), nullptr);
  CHECK(estimate_interpolation_error(few, 1).variance[0] > 0);
}

TEST_CASE("Fewer predictions tell the same of a guide, within their own scatter") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const AnalyticBrdf truth = test::model("blinn-phong", {0.2, 0.3, 50}), guide = test::model("blinn-phong", {0.2, 0.3, 60});
  const GuidedSamples samples = guided_samples(*test::measured(truth, test::planned({}), test::Noise{}, random), &guide);
  const InterpolationError all = estimate_interpolation_error(samples, 2), few = estimate_interpolation_error(samples, 2, 400);
  CHECK(few.ranges.s == all.ranges.s);
  CHECK(few.mean_alone == Approx(all.mean_alone).epsilon(0.15));
  CHECK(few.mean_incidence == Approx(all.mean_incidence).epsilon(0.3));
}
