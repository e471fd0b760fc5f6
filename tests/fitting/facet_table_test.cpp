// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/facet_table.hpp"

#include <cmath>
#include <numbers>

#include "fitting/model_kernel.hpp"
#include "tests/fitting/synthetic.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

const AnalyticBrdf truth("ggx", rgb_channels(), {{0.20, 0.05, 0.9, 0.2}, {0.15, 0.04, 0.8, 0.2}, {0.10, 0.03, 0.7, 0.2}});

/// Directions all over the hemisphere; values of `truth` with 1 % noise and no stated uncertainty.
std::shared_ptr<Dataset> scattered(std::size_t count) {
  test::Random random(test::seed);
  std::normal_distribution<double> normal;
  auto data = std::make_shared<Dataset>();
  data->channels = truth.channels();
  data->f.resize(3);
  for (std::size_t k = 0; k < count; ++k) {
    const GonioAngles a{degrees(test::uniform(random, 0, 85)), degrees(0), degrees(test::uniform(random, 0, 85)),
                        degrees(test::uniform(random, 0, 360))};
    const auto f = truth.eval(a);
    data->angles.push_back(a);
    for (std::size_t c = 0; c < 3; ++c) data->f[c].push_back(f[c] * (1 + 0.01 * normal(random)));
  }
  return data;
}

/// The same sums in double, sample by sample.
std::vector<double> plain_sums(const Dataset& data, double alpha, const VarianceModel* variance) {
  const ModelKernel kernel = model_kernel("ggx");
  std::vector<double> out(3 * FacetTable::sums_per_channel, 0.0);
  for (std::size_t k = 0; k < data.size(); ++k) {
    const LobeGeometry g = lobe_geometry(data.angles[k]);
    double v[4];
    kernel.basis(std::span(&g, 1), &alpha, v, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      v[3] = data.f[c][k];
      const double weight = variance ? 1 / (*variance)(truth.eval(data.angles[k])[c], 0) : 1;
      double* at = out.data() + c * FacetTable::sums_per_channel;
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i <= j; ++i) *at++ += weight * v[i] * v[j];
    }
  }
  return out;
}

constexpr double basis_in_float = 2e-6;

}  // namespace

TEST_CASE("the sums of a facet table are those of the model's basis sample by sample") {
  const auto data = scattered(3001);
  const auto table = FacetTable::of(*observe(data), model_kernel("ggx"), 2);
  REQUIRE(table);
  CHECK(table->rows() == 3001);
  CHECK(table->channels() == 3);
  for (const double alpha : {0.01, 0.2, 1.5}) {
    INFO("alpha " << alpha);
    const auto expected = plain_sums(*data, static_cast<float>(alpha), nullptr), found = table->sums(alpha, 2);
    for (std::size_t k = 0; k < expected.size(); ++k) CHECK(found[k] == Approx(expected[k]).epsilon(basis_in_float));
    CHECK(table->sums(alpha, 1) == found);
  }
}

TEST_CASE("weights of a variance model enter every sum") {
  const auto data = scattered(1000);
  const auto table = FacetTable::of(*observe(data), model_kernel("ggx"), 2);
  REQUIRE(table);
  const VarianceModel variance{1e-8, 0, 0.01, 0};
  std::vector<std::vector<double>> linear;
  for (const auto& values : truth.values()) linear.push_back({values[0], values[1], values[2]});
  table->weigh({variance, variance, variance}, linear, 0.2, 2);
  const auto expected = plain_sums(*data, 0.2f, &variance), found = table->sums(0.2, 2);
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(found[k] == Approx(expected[k]).epsilon(basis_in_float));
}

TEST_CASE("the triangles of sums have the sums as their squares, and a dependent column gets an empty row") {
  const auto data = scattered(500);
  const auto table = FacetTable::of(*observe(data), model_kernel("ggx"), 1);
  REQUIRE(table);
  const auto sums = table->sums(0.3, 1);
  const auto triangles = triangles_of_sums(sums);
  REQUIRE(triangles.size() == 3);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += triangles[c](k, i) * triangles[c](k, j);
        CHECK(sum == Approx(sums[c * FacetTable::sums_per_channel + j * (j + 1) / 2 + i]).epsilon(1e-12));
      }
  // v = (1, 2, x, y) for one sample: everything depends on the first column.
  const Matrix one = triangles_of_sums(std::vector<double>{1, 2, 4, 3, 6, 9, 5, 10, 15, 25}).front();
  CHECK(one(1, 1) == 0);
  CHECK(one(2, 2) == 0);
  CHECK(one(3, 3) == 0);
  CHECK(one(0, 3) == 5);
}

TEST_CASE("every so many samples are a table of their own") {
  const auto data = scattered(1000);
  const auto table = FacetTable::of(*observe(data), model_kernel("ggx"), 1);
  REQUIRE(table);
  const FacetTable some = table->every(7, 2);
  CHECK(some.rows() == 143);
  for (std::size_t k = 0; k < some.samples(0).size(); ++k)
    CHECK(some.values(0, 1)[k] == static_cast<float>(data->f[1][some.samples(0)[k]]));
  CHECK(some.sums(0.2, 1)[0] == Approx(143 * std::numbers::inv_pi * std::numbers::inv_pi));
}

TEST_CASE("there is no facet table for another model, and none with holes") {
  const auto data = scattered(100);
  CHECK_FALSE(FacetTable::of(*observe(data), model_kernel("blinn-phong"), 1));
  data->f[1][17] = NAN;
  CHECK_FALSE(FacetTable::of(*observe(data), model_kernel("ggx"), 1));
  data->f[0][17] = data->f[2][17] = NAN;  // no value in any channel
  const auto table = FacetTable::of(*observe(data), model_kernel("ggx"), 1);
  REQUIRE(table);
  CHECK(table->rows() == 99);
  CHECK(table->not_fitted()[Omission::no_value] == 1);
}

TEST_CASE("GGX with either shadowing has a facet table, so that large tables of it take the short way") {
  const auto data = scattered(50);
  for (const char* name : {"ggx", "ggx-separable"}) CHECK(FacetTable::of(*observe(data), model_kernel(name), 1));
}
