// SPDX-License-Identifier: BSD-3-Clause
// The variance model finds the parts of the noise, and only those that are there.
#include "fitting/variance_model.hpp"

#include <cmath>
#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

struct Truth {
  VarianceModel model;
  double lowest, highest;
};

VarianceModel found(const Truth& truth, std::size_t samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  DeviationCells cells;
  for (std::size_t k = 0; k < samples; ++k) {
    const double f = truth.lowest * std::pow(truth.highest / truth.lowest, uniform(random));
    const double tan2 = tan_squared(std::cos(1.4 * uniform(random)));
    const double deviation = std::sqrt(truth.model(f, tan2)) * normal(random);
    cells.add(f, tan2, deviation * deviation);
  }
  return variance_model(cells);
}

}  // namespace

TEST_CASE("the parts of the noise are found within their statistical uncertainty") {
  const VarianceModel gain_and_read = found({{1e-8, 0, .01, 0}, 1e-3, 100}, 20000, 1);
  CHECK(gain_and_read.gain == Approx(.01).epsilon(.02));
  CHECK(gain_and_read.read == Approx(1e-8).epsilon(.1));
  const VarianceModel shot = found({{1e-8, 1e-5, 0, 0}, 1e-4, 10}, 20000, 2);
  CHECK(shot.shot == Approx(1e-5).epsilon(.05));
  CHECK(shot.gain == Approx(0).margin(1e-3));
  const VarianceModel tilted = found({{0, 0, .003, .01}, .1, 1}, 20000, 3);
  CHECK(tilted.tilt == Approx(.01).epsilon(.05));
  CHECK(tilted.gain == Approx(.003).epsilon(.1));
}

TEST_CASE("a part that the data do not ask for is exactly zero") {
  int shot = 0, tilt = 0, read = 0;
  constexpr int draws = 50;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const VarianceModel model = found({{0, 0, .02, 0}, 1e-2, 10}, 2000, 100 + seed);
    CHECK(model.gain == Approx(.02).epsilon(.1));
    shot += model.shot > 0, tilt += model.tilt > 0, read += model.read > 0;
  }
  // ln 2000 = 7.6 is exceeded by a chi² of one degree of freedom in 0.6 % of draws, half of them on the wrong side of zero.
  CHECK(shot + tilt + read <= 3);
}

TEST_CASE("few degrees of freedom give a constant, none give nothing") {
  DeviationCells cells;
  CHECK(variance_model(cells).empty());
  cells.add(1, 0, 0);
  CHECK(variance_model(cells).empty());
  for (int k = 0; k < 10; ++k) cells.add(std::exp2(k), 0, 4e-6);
  const VarianceModel few = variance_model(cells);
  CHECK(few.read == Approx(4e-6 * 10 / 11));
  CHECK(few.gain == 0);
  cells.clear();
  CHECK(cells.dof() == 0);
}

TEST_CASE("mean squares of repeats count with their degrees of freedom") {
  DeviationCells single, grouped;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int group = 0; group < 200; ++group) {
    const double f = std::exp2(group % 10);
    double sum = 0;
    for (int k = 0; k < 5; ++k) {
      const double deviation = .01 * f * normal(random);
      single.add(f, 0, deviation * deviation);
      sum += deviation * deviation;
    }
    grouped.add(f, 0, sum / 5, 5);
  }
  CHECK(grouped.dof() == single.dof());
  CHECK(variance_model(grouped).gain == Approx(variance_model(single).gain));
}

TEST_CASE("values that are no deviations are left out, extreme ones stay finite") {
  DeviationCells cells;
  cells.add(std::nan(""), 0, 1);
  cells.add(1, 0, INFINITY);
  cells.add(1, 0, 1, 0);
  CHECK(cells.dof() == 0);
  for (const double f : {-1.0, 0.0, 1e-300, 1e300})
    for (int k = 0; k < 20; ++k) cells.add(f, tan_squared(0), 1e-4);
  const VarianceModel model = variance_model(cells);
  CHECK(std::isfinite(model(1, 0)));
  CHECK(model(-5, 0) == model(0, 0));
}

TEST_CASE("the truncated second moment is that of the normal distribution") {
  CHECK(truncated_second_moment(2) == Approx(.92054).epsilon(1e-4));
  CHECK(truncated_second_moment(40) == Approx(1));
}
