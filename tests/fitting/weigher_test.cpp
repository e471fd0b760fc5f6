// SPDX-License-Identifier: BSD-3-Clause
// Weights from the scatter of the data, and wrong readings left out: on terms with a fitter that needs no scan.
#include "fitting/weigher.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// Two levels of f, half of the samples each, with gain noise: the model is the weighted mean of each half.
struct TwoLevels {
  Terms terms;
  std::vector<bool> bright;

  TwoLevels(std::size_t count, double gain, unsigned seed) {
    terms.kernel = model_kernel("lambert");
    terms.geometry.resize(count);
    terms.channel.resize(1);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    ChannelTerms& channel = terms.channel[0];
    for (std::size_t k = 0; k < count; ++k) {
      bright.push_back(k % 2);
      terms.sample.push_back(k);
      channel.value.push_back((bright[k] ? 50 : .1) * (1 + gain * normal(random)));
      channel.weight.push_back(1);
    }
    channel.target = channel.value;
    channel.count = count;
  }

  std::optional<std::vector<std::vector<double>>> fitted() const {
    double weight[2] = {}, sum[2] = {};
    for (std::size_t k = 0; k < bright.size(); ++k) {
      weight[bright[k]] += terms.channel[0].weight[k];
      sum[bright[k]] += terms.channel[0].weight[k] * terms.channel[0].value[k];
    }
    std::vector<double> out;
    for (const bool b : bright) out.push_back(sum[b] / weight[b]);
    return std::vector<std::vector<double>>{out};
  }
};

Weighting weighed(TwoLevels& data, Robust robust, std::span<const RepeatedReadings> repeats = {}) {
  return weigh(data.terms, {true, robust, 2, repeats}, [&](bool) { return data.fitted(); });
}

}  // namespace

TEST_CASE("weights follow the variance the residuals show") {
  TwoLevels data(4000, .01, 1);
  const Weighting weighting = weighed(data, Robust::automatic);
  CHECK(weighting.source == WeightSource::residuals);
  CHECK(weighting.robust == Robust::none);
  CHECK(weighting.n_outliers == 0);
  CHECK(std::sqrt(weighting.variance[0](50, 0)) == Approx(.5).epsilon(.05));
  CHECK(std::sqrt(weighting.variance[0](.1, 0)) == Approx(.001).epsilon(.05));
  const std::vector<double>& w = data.terms.channel[0].weight;
  CHECK(w[0] / w[1] == Approx(250000).epsilon(.2));
}

TEST_CASE("clean data get the same weights with and without robustness, bit for bit") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    TwoLevels plain(2000, .01, 100 + seed), robust(2000, .01, 100 + seed);
    weighed(plain, Robust::none);
    const Weighting weighting = weighed(robust, Robust::automatic);
    INFO(seed << ": " << weighting.reason);
    CHECK(plain.terms.channel[0].weight == robust.terms.channel[0].weight);
  }
}

TEST_CASE("single wrong readings lose their weight and are listed with their place") {
  for (const double share : {.002, .01, .05}) {
    TwoLevels data(4000, .01, 7);
    std::mt19937_64 random(3);
    std::bernoulli_distribution hit(share);
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < 4000; ++k)
      if (hit(random)) data.terms.channel[0].value[k] = data.terms.channel[0].target[k] *= 20, wrong.push_back(k);
    const Weighting weighting = weighed(data, Robust::automatic);
    INFO(share << ": " << weighting.reason);
    CHECK(weighting.robust == Robust::automatic);
    std::vector<std::size_t> listed;
    for (const Outlier& outlier : weighting.outliers) {
      listed.push_back(outlier.sample);
      CHECK(std::abs(outlier.z) > 100);
      CHECK(outlier.value == data.terms.channel[0].value[outlier.sample]);
    }
    CHECK(listed == wrong);
    for (const std::size_t k : wrong) CHECK(data.terms.channel[0].weight[k] == 0);
    CHECK(data.terms.channel[0].count == 4000 - wrong.size());
    const auto fitted = *data.fitted();
    CHECK(fitted[0][0] == Approx(.1).epsilon(2e-3));
    CHECK(fitted[0][1] == Approx(50).epsilon(2e-3));
  }
}

TEST_CASE("large residuals in a run are a misfit and stay") {
  TwoLevels data(2000, .01, 9);
  for (std::size_t k = 500; k < 560; ++k) data.terms.channel[0].value[k] = data.terms.channel[0].target[k] *= 1.3;
  const Weighting weighting = weighed(data, Robust::automatic);
  CHECK(weighting.robust == Robust::none);
  CHECK(weighting.reason.find("runs") != std::string::npos);
  CHECK(data.terms.channel[0].weight[520] > 0);
}

TEST_CASE("a loss that is asked for weighs wrong readings down") {
  for (const Robust loss : {Robust::huber, Robust::cauchy}) {
    TwoLevels data(4000, .01, 11);
    data.terms.channel[0].value[10] = data.terms.channel[0].target[10] = 3;
    const Weighting weighting = weighed(data, loss);
    CHECK(weighting.robust == loss);
    CHECK(weighting.n_outliers == 1);
    CHECK(data.terms.channel[0].weight[10] > 0);
    CHECK(data.terms.channel[0].weight[10] < .01 * data.terms.channel[0].weight[12]);
  }
}

TEST_CASE("repeats give the variance whatever the model misses") {
  TwoLevels data(4000, .01, 13);
  std::vector<RepeatedReadings> repeats;
  for (std::size_t k = 0; k + 2 < 4000; k += 4) repeats.push_back({k, k + 2}), repeats.push_back({k + 1, k + 3});
  // A drift the two levels cannot follow, the same for both readings of a pair.
  for (std::size_t k = 0; k < 4000; ++k)
    data.terms.channel[0].value[k] = data.terms.channel[0].target[k] *= 1 + .1 * std::sin(static_cast<double>(k / 4));
  const Weighting weighting = weighed(data, Robust::none, repeats);
  CHECK(weighting.source == WeightSource::repeats);
  CHECK(std::sqrt(weighting.variance[0](50, 0)) == Approx(.5).epsilon(.06));
  TwoLevels few(4000, .01, 13);
  CHECK(weighed(few, Robust::none, std::span(repeats).first(100)).source == WeightSource::residuals);
}

TEST_CASE("too few samples keep their weights") {
  TwoLevels data(20, .01, 15);
  const Weighting weighting = weighed(data, Robust::automatic);
  CHECK(weighting.source == WeightSource::none);
  for (const double w : data.terms.channel[0].weight) CHECK(w == 1);
}

TEST_CASE("exact data keep finite weights") {
  TwoLevels data(400, 0, 17);
  weighed(data, Robust::automatic);
  for (const double w : data.terms.channel[0].weight) {
    CHECK(std::isfinite(w));
    CHECK(w > 0);
  }
}

TEST_CASE("of many outliers the farthest are listed and all are counted") {
  Weighting weighting;
  std::vector<Outlier> many;
  for (std::size_t k = 0; k < 3000; ++k) many.push_back({k, 0, 1, 0, static_cast<double>(k)});
  weighting.add(many);
  CHECK(weighting.n_outliers == 3000);
  REQUIRE(weighting.outliers.size() == Weighting::most_listed);
  CHECK(weighting.outliers.front().sample == 2000);
  CHECK(weights_named("variance") == Weights::variance);
  CHECK_FALSE(weights_named("some"));
}
