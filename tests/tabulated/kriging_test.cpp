// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/kriging.hpp"

#include <cmath>
#include <numeric>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::vector<PairPoint> corners() {
  std::vector<PairPoint> out;
  for (int k = 0; k < 8; ++k) out.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2), 0});
  return out;
}

}  // namespace

TEST_CASE("Weights add up to 1, are one point's alone at that point, and equal in the middle of a cube") {
  KrigingWeights out;
  for (const double range : {0.5, 2.0, 16.0}) {
    ordinary_kriging({0.5, 0.5, 0.5, 0}, corners(), {range, range}, out);
    CHECK(std::accumulate(out.weight.begin(), out.weight.end(), 0.0) == Approx(1).epsilon(1e-9));
    for (const double w : out.weight) CHECK(w == Approx(0.125).epsilon(1e-6));
    CHECK(out.variance > 0);
    ordinary_kriging(corners()[3], corners(), {range, range}, out);
    for (std::size_t k = 0; k < 8; ++k) CHECK(std::fabs(out.weight[k] - (k == 3 ? 1 : 0)) < 1e-5);
    CHECK(out.variance < 1e-8);
  }
}

TEST_CASE("The variance is that of the errors on random fields of the same correlation") {
  // A field with Matérn's correlation on a few points, by the Cholesky factor of its covariance.
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  std::vector<PairPoint> points = corners();
  const PairPoint at{0.3, 0.6, 0.2, 0};
  const CorrelationRanges ranges{2, 3};
  KrigingWeights out;
  ordinary_kriging(at, points, ranges, out);
  points.push_back(at);
  const std::size_t n = points.size();
  std::vector<std::vector<double>> lower(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = matern_correlation(points[i], points[j], ranges);
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
      lower[i][j] = i == j ? std::sqrt(sum) : sum / lower[j][j];
    }
  std::normal_distribution<double> normal;
  constexpr int fields = 20000;
  double squared = 0, tilted = 0;
  for (int field = 0; field < fields; ++field) {
    std::vector<double> white(n), value(n, 7.0);
    for (double& w : white) w = normal(random);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k <= i; ++k) value[i] += lower[i][k] * white[k];
    double predicted = 0;
    for (std::size_t k = 0; k + 1 < n; ++k) predicted += out.weight[k] * value[k];
    squared += (predicted - value[n - 1]) * (predicted - value[n - 1]) / fields;
    tilted += (value[0] - value[n - 1]) * (value[0] - value[n - 1]) / fields;
  }
  CHECK(squared / out.variance == Approx(1).margin(0.04));  // four standard errors of 20 000 fields
  CHECK(tilted > 2 * out.variance);                         // the nearest point alone is worse
}
