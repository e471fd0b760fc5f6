// SPDX-License-Identifier: BSD-3-Clause
// What a fit does by default with data that state no uncertainty: weights from their scatter, wrong readings left out.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/fit.hpp"
#include "tests/fitting/ngan_grid.hpp"
#include "tests/fitting/wrong_readings.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

FitResult fit_of(std::shared_ptr<Dataset> data) {
  FitOptions options;
  options.model = "blinn-phong-ngan";
  return fit(*observe(std::move(data)), options);
}

const NoisyReadings& noisy(double s) {
  static const NoisyReadings broad(ngan_material(50), gantry_grid()), narrow(ngan_material(2000), gantry_grid());
  return s < 1000 ? broad : narrow;
}

double s_of(const FitResult& result) { return result.values[0][2]; }

}  // namespace

TEST_CASE("1 % of readings 20 times too high move the exponent by less than 0.3 % and rho_d by less than 1 %") {
  for (const double s : {50.0, 2000.0})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      auto data = noisy(s).draw(seed);
      const std::size_t count = spoil(data->f, seed);
      const FitResult result = fit_of(data);
      INFO("s " << s << ", seed " << seed << ": " << result.weighting.reason);
      CHECK(s_of(result) == Approx(s).epsilon(.003));
      CHECK(result.values[0][0] == Approx(.2).epsilon(.01));
      CHECK(result.values[2][0] == Approx(.1).epsilon(.01));
      CHECK(result.weighting.robust == Robust::automatic);
      CHECK(result.weighting.n_outliers == count);
      for (const Outlier& outlier : result.weighting.outliers)
        CHECK(outlier.angles.theta_o.degrees() == data->angles[outlier.sample].theta_o.degrees());
    }
}

TEST_CASE("least squares alone is led astray by the same readings") {
  auto data = noisy(50).draw(1);
  spoil(data->f, 1);
  FitOptions options;
  options.model = "blinn-phong-ngan";
  options.robust = Robust::none;
  CHECK(std::abs(fit(*observe(data), options).values[0][0] - .2) > .01);
}

TEST_CASE("clean data give the answer of plain weighted least squares, bit for bit") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto data = noisy(2000).draw(seed);
    FitOptions plain;
    plain.model = "blinn-phong-ngan";
    plain.robust = Robust::none;
    const FitResult robust = fit_of(data), least_squares = fit(*observe(data), plain);
    CHECK(robust.weighting.n_outliers == 0);
    CHECK(robust.values == least_squares.values);
  }
}

TEST_CASE("a row of NaN is left out, counted, and changes nothing else") {
  auto data = noisy(50).draw(4), without = noisy(50).draw(4);
  for (auto& f : data->f) f[777] = std::numeric_limits<double>::quiet_NaN();
  for (auto& f : without->f) f.erase(f.begin() + 777);
  without->angles.erase(without->angles.begin() + 777);
  const FitResult result = fit_of(data), clean = fit_of(without);
  CHECK(result.not_fitted.total() == 1);
  CHECK(result.n_observations == 11663);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) CHECK(result.values[c][k] == Approx(clean.values[c][k]).epsilon(1e-9));
}

TEST_CASE("a metric that is named is the plain sum of its table, without one the weights are estimated") {
  const auto data = noisy(50).draw(5);
  FitOptions named;
  named.model = "blinn-phong-ngan";
  named.metric = Metric::linear;
  const FitResult plain = fit(*observe(data), named), weighed = fit_of(data);
  CHECK(plain.weighting.source == WeightSource::none);
  CHECK(plain.weighting.reason.empty());
  CHECK(weighed.weighting.source == WeightSource::residuals);
  named.weights = Weights::variance;
  CHECK(fit(*observe(data), named).values == [&] {
    FitOptions same = named;
    same.metric.reset();
    same.robust = Robust::none;
    return fit(*observe(data), same).values;
  }());
  CHECK(weighed.weighting.variance.size() == 3);
  CHECK(weighed.weighting.variance[0](1, 0) == Approx(1e-4).epsilon(.1));
}

TEST_CASE("intervals hold the truth in 95 % of draws, and the errors are those of the right weights") {
  constexpr int draws = 100;
  // Of 100 draws with 95 % coverage fewer than 87 or more than 100 hits come in 0.1 % of cases for one parameter of seven.
  constexpr int fewest = 86;
  std::array<int, 7> hits{};
  double square_s = 0, square_d = 0;
  const std::array<double, 7> truth{.2, .3, .15, .3, .1, .3, 2000};
  for (unsigned seed = 0; seed < draws; ++seed) {
    const FitResult result = fit_of(noisy(2000).draw(1000 + seed));
    REQUIRE(result.parameters.size() == 7);
    for (std::size_t k = 0; k < 7; ++k) {
      const FittedParameter& p = result.parameters[k];
      hits[k] += p.low && p.high && truth[k] >= *p.low && truth[k] <= *p.high;
    }
    square_s += std::pow(s_of(result) - 2000, 2);
    square_d += std::pow(result.values[0][0] - .2, 2);
  }
  for (std::size_t k = 0; k < 7; ++k) {
    INFO("parameter " << k);
    CHECK(hits[k] >= fewest);
  }
  CHECK(std::sqrt(square_s / draws) < .5);
  CHECK(std::sqrt(square_d / draws) < 2.5e-5);
}
