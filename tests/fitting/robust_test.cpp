// SPDX-License-Identifier: BSD-3-Clause
// Robust means and losses: exact on clean values, unmoved by wrong ones.
#include "fitting/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

std::vector<double> normal_values(std::size_t count, double mean, double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(mean, sigma);
  std::vector<double> values(count);
  for (double& value : values) value = normal(random);
  return values;
}

bool looks_clean(const std::vector<double>& values) {
  std::vector<double> some;
  const std::size_t stride = (values.size() + judges - 1) / judges;
  for (std::size_t k = 0; k < values.size(); k += stride) some.push_back(values[k]);
  const CleanRange range = clean_range(some, values.size());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *least >= range.low && *most <= range.high;
}

double plain_mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("clean values look clean and give their plain mean") {
  std::vector<double> scratch;
  int clean = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<double> values = normal_values(2000, .2, .002, seed);
    clean += looks_clean(values);
    const RobustMean robust = robust_mean(values, Robust::automatic, scratch);
    CHECK(robust.outliers.size() <= 1);
    if (robust.outliers.empty()) CHECK(robust.mean == Approx(plain_mean(values)).epsilon(1e-13));
    CHECK(robust.scale == Approx(.002).epsilon(.15));
  }
  CHECK(clean == 200);
}

TEST_CASE("wrong values are seen, left out and listed") {
  std::vector<double> scratch;
  for (const double share : {.001, .01, .05, .1}) {
    std::vector<double> values = normal_values(4000, .2, .002, 7);
    double sum = 0, kept = 0;
    std::vector<std::size_t> wrong;
    std::mt19937_64 random(3);
    std::bernoulli_distribution hit(share);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (hit(random) && (wrong.empty() || wrong.back() + 1 < k))
        values[k] *= 20, wrong.push_back(k);
      else
        sum += values[k], kept += 1;
    CHECK_FALSE(looks_clean(values));
    const RobustMean robust = robust_mean(values, Robust::automatic, scratch);
    CHECK(robust.outliers == wrong);
    CHECK(robust.mean == Approx(sum / kept).epsilon(1e-12));
    CHECK(robust.within / static_cast<double>(robust.count - 1) == Approx(4e-6).epsilon(.1));
    CHECK(robust_mean(values, Robust::cauchy, scratch).mean == Approx(.2).epsilon(1e-3));
    CHECK(robust_mean(values, Robust::huber, scratch).mean == Approx(.2).epsilon(.003));
    CHECK(robust_mean(values, Robust::none, scratch).mean == Approx(plain_mean(values)));
  }
}

TEST_CASE("far values in a run are a spread that is not normal, and stay") {
  std::vector<double> values = normal_values(1000, .2, .002, 9), scratch;
  for (std::size_t k = 100; k < 160; ++k) values[k] = .3;
  const RobustMean robust = robust_mean(values, Robust::automatic, scratch);
  CHECK(robust.outliers.empty());
  CHECK(robust.mean == Approx(plain_mean(values)));
}

TEST_CASE("the stated variance of a robust mean is the one it has") {
  for (const Robust loss : {Robust::automatic, Robust::huber, Robust::cauchy}) {
    std::vector<double> scratch;
    constexpr int draws = 1000;
    constexpr std::size_t count = 200;
    double square = 0, stated = 0;
    for (unsigned seed = 0; seed < draws; ++seed) {
      const RobustMean robust = robust_mean(normal_values(count, 0, 1, 1000 + seed), loss, scratch);
      square += robust.mean * robust.mean;
      stated += robust.within / static_cast<double>((robust.count - 1) * robust.count);
    }
    INFO(name(loss));
    // The relative spread of a variance from 1000 draws is √(2/1000) = 4.5 %.
    CHECK(square / stated == Approx(1).epsilon(.15));
  }
}

TEST_CASE("equal values, few values and no values have a mean and no outliers") {
  std::vector<double> scratch;
  CHECK(robust_mean(std::vector<double>(50, .3), Robust::automatic, scratch).mean == .3);
  CHECK(looks_clean(std::vector<double>(50, .3)));
  const RobustMean few = robust_mean(std::vector<double>{1, 1.01, .99, 50}, Robust::automatic, scratch);
  CHECK(few.mean == Approx(13.25));
  CHECK(few.outliers.empty());
  CHECK(robust_mean({}, Robust::automatic, scratch).count == 0);
}

TEST_CASE("losses are named as on the command line and weigh as they say") {
  for (const Robust robust : {Robust::automatic, Robust::none, Robust::huber, Robust::cauchy}) CHECK(robust_named(name(robust)) == robust);
  CHECK_FALSE(robust_named("tukey"));
  CHECK(loss_weight(Robust::huber, 1) == 1);
  CHECK(loss_weight(Robust::huber, -13.45) == Approx(.1));
  CHECK(loss_weight(Robust::cauchy, 2.385) == Approx(.5));
  CHECK(loss_weight(Robust::none, 100) == 1);
  CHECK(outlier_limit(30000) == Approx(5.52).epsilon(.01));
}

TEST_CASE("runs are told from single outliers") {
  CHECK_FALSE(in_runs(std::vector<std::size_t>{3, 9, 10, 20, 40}));
  CHECK(in_runs(std::vector<std::size_t>{3, 4, 5, 20}));
  CHECK_FALSE(in_runs({}));
}
