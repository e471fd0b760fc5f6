// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/prediction.hpp"

#include <cmath>

#include "fitting/subset.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

Samples all_of(const std::shared_ptr<Dataset>& data) {
  const std::shared_ptr<const Observations> observations = observe(data);
  const std::vector<std::uint8_t> every(sample_count(*observations), 1);
  return gather(*observations, every, std::vector<std::uint8_t>(every.size(), 0));
}

}  // namespace

TEST_CASE("the errors of a prediction are those of the fit") {
  const auto data = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 20), test::polar_grid({20, 50}, 5, 20), {.relative = 0.05}, 5);
  const FitResult result = fit(*observe(data), {});
  const PredictionSums sums = prediction_sums(all_of(data), model_info("blinn-phong"), result.values, std::nullopt);
  constexpr double rounding = 1e-12;
  CHECK(*sums.error(Metric::linear) == Approx(result.errors.linear).epsilon(rounding));
  CHECK(*sums.error(Metric::linear_cos) == Approx(result.errors.linear_cos).epsilon(rounding));
  CHECK(*sums.error(Metric::log) == Approx(result.errors.log).epsilon(rounding));
  CHECK(*sums.error(Metric::log1p) == Approx(result.errors.log1p).epsilon(rounding));
  CHECK(*sums.error(Metric::cbrt) == Approx(result.errors.cbrt).epsilon(rounding));
}

TEST_CASE("groups add up to the whole, and a prediction of 0 has no logarithm") {
  const auto data = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 20), test::polar_grid({20, 50}, 5, 20), {.relative = 0.05}, 5);
  Samples samples = all_of(data);
  for (std::size_t k = 0; k < samples.size(); ++k) samples.group[k] = k % 2;
  const ModelInfo& model = model_info("lambert");
  PredictionSums parts = prediction_sums(samples, model, {{0.3}}, 0);
  parts += prediction_sums(samples, model, {{0.3}}, 1);
  const PredictionSums whole = prediction_sums(samples, model, {{0.3}}, std::nullopt);
  CHECK(*parts.error(Metric::cbrt) == Approx(*whole.error(Metric::cbrt)).epsilon(1e-12));
  const PredictionSums black = prediction_sums(samples, model, {{0.0}}, std::nullopt);
  CHECK_FALSE(black.error(Metric::log));
  CHECK(*black.relative_error(Metric::linear_cos) == Approx(1));
  CHECK(*black.relative_error(Metric::cbrt) == Approx(1));
}

TEST_CASE("noise is what the data state, or what their repeats show, or unknown") {
  const auto angles = test::polar_grid({20, 50}, 5, 20);
  const auto stated = test::readings(test::lobe("lambert+blinn-phong", 0.2, 0.0, 20), angles, {.relative = 0.03}, 5);
  const NoiseLevel by_u = noise_level(*observe(stated), all_of(stated));
  CHECK(by_u.source == NoiseLevel::Source::stated);
  CHECK(by_u.linear_cos == Approx(0.03).epsilon(0.02));
  CHECK(3 * by_u.cbrt == Approx(0.03).epsilon(0.02));

  auto twice = std::make_shared<Dataset>(*stated);
  const auto again = test::readings(test::lobe("lambert+blinn-phong", 0.2, 0.0, 20), angles, {.relative = 0.03}, 6);
  twice->angles.insert(twice->angles.end(), angles.begin(), angles.end());
  twice->f[0].insert(twice->f[0].end(), again->f[0].begin(), again->f[0].end());
  twice->u.clear();
  const NoiseLevel by_repeats = noise_level(*observe(twice), all_of(twice));
  CHECK(by_repeats.source == NoiseLevel::Source::repeats);
  CHECK(by_repeats.linear_cos == Approx(0.03).epsilon(0.1));
  CHECK(3 * by_repeats.cbrt == Approx(0.03).epsilon(0.1));

  auto bare = std::make_shared<Dataset>(*stated);
  bare->u.clear();
  CHECK(noise_level(*observe(bare), all_of(bare)).source == NoiseLevel::Source::unknown);
}

TEST_CASE("the likelihood prefers the truth by chi squared, or by the logarithm of the squares") {
  const AnalyticBrdf truth = test::lobe("blinn-phong", 0.2, 0.3, 20);
  const auto data = test::readings(truth, test::polar_grid({20, 50}, 5, 20), {.relative = 0.02}, 5);
  const ModelInfo& model = model_info("blinn-phong");
  const Likelihood good = likelihood(all_of(data), model, truth.values(), Metric::linear);
  CHECK(good.weighted);
  CHECK(good.n == data->size());
  CHECK(good.minus_two_log / static_cast<double>(good.n) == Approx(1).margin(0.15));
  CHECK(likelihood(all_of(data), model, {{0.2, 0.3, 22}}, Metric::linear).minus_two_log > good.minus_two_log + 10);
  data->u.clear();
  const Likelihood bare = likelihood(all_of(data), model, truth.values(), Metric::cbrt);
  CHECK_FALSE(bare.weighted);
  CHECK(likelihood(all_of(data), model, {{0.2, 0.3, 22}}, Metric::cbrt).minus_two_log > bare.minus_two_log + 1);
}
