// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/large_table.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/fit.hpp"
#include "fitting/profile.hpp"
#include "tests/fitting/synthetic.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr double alpha = 0.15;
const AnalyticBrdf truth("ggx", rgb_channels(), {{0.20, 0.05, 0.9, alpha}, {0.15, 0.04, 0.8, alpha}, {0.10, 0.03, 0.7, alpha}});

/// More samples than a table must have to be called large, half of them near the mirror direction; no stated uncertainty.
std::shared_ptr<Dataset> many_samples(double relative_noise, double noise) {
  test::Random random(test::seed);
  std::normal_distribution<double> normal;
  auto data = std::make_shared<Dataset>();
  data->channels = truth.channels();
  data->f.resize(3);
  for (std::size_t k = 0; k < 210'000; ++k) {
    const double theta_i = test::uniform(random, 0, 80), spread = k % 2 == 0 ? 15 : 80;
    const double theta_o = k % 2 == 0 ? std::fabs(theta_i + test::uniform(random, -spread, spread)) : test::uniform(random, 0, spread);
    const GonioAngles a{degrees(theta_i), degrees(0), degrees(std::fmin(theta_o, 85)),
                        degrees(180 + test::uniform(random, -spread, spread))};
    const auto f = truth.eval(a);
    data->angles.push_back(a);
    for (std::size_t c = 0; c < 3; ++c) data->f[c].push_back(f[c] + std::hypot(relative_noise * f[c], noise) * normal(random));
  }
  return data;
}

std::vector<LinearLimits> free_limits(std::size_t channels) { return {channels, {std::vector<double>(3, NAN), {}, {}}}; }

}  // namespace

TEST_CASE("the profile of a large table is that of its rows, before and after a stretch is prepared") {
  const auto observations = observe(many_samples(0.01, 0));
  const ModelKernel kernel = model_kernel("ggx");
  auto large = large_table(*observations, kernel, Metric::linear, 2);
  REQUIRE(large);
  CHECK(large->terms.rows() < 40'000);
  CHECK(large->part.rows() < 3'000);
  const Terms all = make_terms(*observations, kernel, Metric::linear, 2);
  CHECK(large->terms.n_observations == all.n_observations);
  const Profile by_rows(all, free_limits(3));
  Profile by_sums(large->terms, free_limits(3));
  const auto compare = [&](double at) {
    INFO("alpha " << at);
    const ProfilePoint expected = by_rows.at(std::span(&at, 1), 2), found = by_sums.at(std::span(&at, 1), 2);
    // The squares of the values are 10 000 times the cost: 1e-6 of the basis in float, at random, leaves this of it.
    CHECK(found.cost == Approx(expected.cost).epsilon(2e-4));
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) CHECK(found.channel[c].x[k] == Approx(expected.channel[c].x[k]).epsilon(1e-5).margin(1e-6));
  };
  for (const double at : {0.03, 0.145, 0.15, 0.6}) compare(at);
  by_sums.prepare(SearchSpace(kernel, {{NAN, NAN, NAN}}, {true}), std::log(0.13), std::log(0.17), 2);
  for (const double at : {0.131, 0.145, 0.15, 0.169, 0.6}) compare(at);
}

TEST_CASE("a fit of a large table finds the truth within its intervals, with weights from the scatter and without") {
  FitOptions options;
  options.model = "ggx";
  for (const bool weighted : {false, true}) {
    INFO("weighted " << weighted);
    const auto observations = observe(weighted ? many_samples(0.01, 1e-4) : many_samples(0, 0.01));
    if (!weighted)
      options.metric = Metric::linear, options.robust = Robust::none;
    else
      options.metric.reset(), options.robust = Robust::automatic;
    const FitResult result = fit(*observations, options);
    CHECK(result.status == Status::converged);
    CHECK(result.n_observations == 210'000);
    CHECK((result.weighting.source == WeightSource::residuals) == weighted);
    for (const FittedParameter& p : result.parameters) {
      const std::vector<double>& values = truth.values()[p.channel.value_or(0)];
      const double wanted = p.name == "rho_d" ? values[0] : p.name == "f0" ? values[1] : p.name == "f90" ? values[2] : values[3];
      INFO(p.name << " " << p.value << " for " << wanted);
      REQUIRE(p.kind == IntervalKind::interval);
      REQUIRE(p.sigma);
      CHECK(std::fabs(p.value - wanted) < 5 * *p.sigma);  // ten parameters: five sigma is past any doubt
      CHECK(*p.sigma < 2e-2 * wanted);
      CHECK(*p.low < p.value);
      CHECK(*p.high > p.value);
    }
  }
}

TEST_CASE("no large table for few samples, stated uncertainties or another metric") {
  const ModelKernel kernel = model_kernel("ggx");
  const auto data = many_samples(0.01, 0);
  CHECK_FALSE(large_table(*observe(data), kernel, Metric::log, 2));
  data->u = data->f;
  CHECK_FALSE(large_table(*observe(data), kernel, Metric::linear, 2));
  const auto grid = test::readings(truth, test::polar_grid({20, 40}, 10, 30), {}, 1);
  CHECK_FALSE(large_table(*observe(grid), kernel, Metric::linear, 2));
}

TEST_CASE("wrong readings in a large table are left out and listed, and move nothing") {
  const auto data = many_samples(0.01, 1e-4);
  std::size_t spoilt = 0;
  for (std::size_t k = 11; k < data->angles.size(); k += 97, ++spoilt) data->f[spoilt % 3][k] *= 20;
  FitOptions options;
  options.model = "ggx";
  const FitResult result = fit(*observe(data), options);
  REQUIRE(result.status == Status::converged);
  CHECK(result.weighting.robust == Robust::automatic);
  CHECK_FALSE(result.rows.reason.empty());
  CHECK(result.n_observations <= options.most_samples);
  const double of_part =
      static_cast<double>(spoilt) * static_cast<double>(result.n_observations) / static_cast<double>(data->angles.size());
  CHECK(static_cast<double>(result.weighting.n_outliers) == Approx(of_part).epsilon(0.15));  // half a thousand of them, drawn one of four
  for (const Outlier& outlier : result.weighting.outliers) CHECK(outlier.sample % 97 == 11);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(result.values[c][3] == Approx(alpha).epsilon(0.003));
    CHECK(result.values[c][0] == Approx(truth.values()[c][0]).epsilon(0.01));
    CHECK(result.values[c][1] == Approx(truth.values()[c][1]).epsilon(0.01));
  }
}

TEST_CASE("of more samples than asked for an even part is fitted, which the result says, the same for any number of threads") {
  const auto observations = observe(many_samples(0.01, 1e-4));
  FitOptions options;
  options.model = "cook-torrance";
  options.most_samples = 20'000;
  options.threads = 1;
  const FitResult one = fit(*observations, options);
  options.threads = 2;
  const FitResult two = fit(*observations, options);
  CHECK(one.values == two.values);
  CHECK(one.n_observations == one.rows.count);
  CHECK(one.rows.of == RowsOf::samples);
  CHECK(one.rows.reason.find("one of every 11") != std::string::npos);
  const Terms part =
      make_terms(*observations, model_kernel("cook-torrance"), Metric::linear, 2, Robust::none, Weights::automatic, options.most_samples);
  std::size_t least = 210'000, most = 0;
  for (std::size_t first = 0; first < 210'000; first += 2'100) {
    const auto in_it = static_cast<std::size_t>(
        std::count_if(part.sample.begin(), part.sample.end(), [&](std::size_t k) { return k >= first && k < first + 2'100; }));
    least = std::min(least, in_it), most = std::max(most, in_it);
  }
  CHECK(least >= 2'100 / 11 - 2);  // but for the groups that the ends cut
  CHECK(most <= 2'100 / 11 + 3);
  CHECK(make_terms(*observations, model_kernel("cook-torrance"), Metric::linear, 2).rows() == 210'000);
}
