// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/marginal_warp.hpp"

#include <cmath>
#include <random>

#include "tests/check.hpp"

using namespace gonio::tabulated;

namespace {

constexpr double rounding = 1e-12;
const SliceWeights first_slice{{0, 0, 0, 0}, {1, 0, 0, 0}};

}  // namespace

TEST_CASE("A uniform density is left as it is") {
  const MarginalWarp warp(std::vector<float>(12, 3.0f), 3, 4);
  const UnitPoint p = warp.invert(first_slice, {0.3, 0.8});
  CHECK(std::fabs(p.x - 0.3) < rounding);
  CHECK(std::fabs(p.y - 0.8) < rounding);
}

TEST_CASE("A density that grows along x gives its integral, x squared") {
  std::vector<float> density;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 5; ++column) density.push_back(static_cast<float>(column));
  const MarginalWarp warp(density, 3, 5);
  for (const double x : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const UnitPoint p = warp.invert(first_slice, {x, 0.4});
    CHECK(std::fabs(p.x - x * x) < rounding);
    CHECK(std::fabs(p.y - 0.4) < rounding);
  }
}

TEST_CASE("Sampling and inversion are each other's inverse, columns without density included") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(0, 1);
  constexpr std::size_t rows = 7, columns = 6;
  std::vector<float> density(2 * rows * columns);
  for (std::size_t k = 0; k < density.size(); ++k) density[k] = k % columns >= 4 ? 0.0f : number(random);
  const MarginalWarp warp(density, rows, columns);
  const SliceWeights second{{1, 1, 1, 1}, {1, 0, 0, 0}};
  for (int k = 0; k < 500; ++k) {
    const UnitPoint s{static_cast<double>(number(random)), static_cast<double>(number(random))};
    const UnitPoint back = warp.invert(second, warp.sample(1, s));
    // The borders are drawn in by 6e-8.
    CHECK(std::fabs(back.x - s.x) < 1e-7);
    CHECK(std::fabs(back.y - s.y) < 1e-7);
  }
}

TEST_CASE("Between slices normalised densities are mixed, whatever their scale") {
  std::vector<float> density;
  for (int slice = 0; slice < 2; ++slice)
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 2; ++column) density.push_back(slice == 0 ? 1.0f : 1000.0f * static_cast<float>(column));
  const MarginalWarp warp(density, 2, 2);
  const UnitPoint p = warp.invert({{0, 1, 0, 0}, {0.25, 0.75, 0, 0}}, {0.5, 0.5});
  CHECK(std::fabs(p.x - (0.25 * 0.5 + 0.75 * 0.25)) < rounding);
  CHECK(std::fabs(p.y - 0.5) < rounding);
}

TEST_CASE("Densities come back as they were given, and many points go where one goes") {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> number(0, 1);
  constexpr std::size_t rows = 5, columns = 7;
  std::vector<float> density(3 * rows * columns);
  for (float& value : density) value = number(random);
  const MarginalWarp warp(density, rows, columns);
  CHECK(warp.density() == density);

  SquareColumn y, x, to_y, to_x;
  for (std::size_t k = 0; k < square_batch; ++k) y[k] = static_cast<double>(number(random)), x[k] = static_cast<double>(number(random));
  const std::vector<SliceWeights> slices(square_batch, {{1, 2, 0, 0}, {0.3, 0.7, 0, 0}});
  SquareCells cells;
  find_square_cells(y, x, square_batch, rows, columns, cells);
  warp.invert(slices.data(), cells, square_batch, to_y, to_x);
  for (std::size_t k = 0; k < square_batch; ++k) {
    const UnitPoint one = warp.invert(slices[k], {x[k], y[k]});
    CHECK(to_x[k] == one.x);
    CHECK(to_y[k] == one.y);
  }
}

TEST_CASE("A row without any density has no image") {
  const MarginalWarp warp({0, 0, 0, 0, 1, 1}, 3, 2);
  CHECK(std::isnan(warp.invert(first_slice, {0.5, 0.2}).x));
  CHECK_FALSE(std::isnan(warp.invert(first_slice, {0.5, 0.7}).x));
}

TEST_CASE("Neighbours beyond the ends are the end alone") {
  const std::vector<float> axis{0.0f, 1.0f, 3.0f};
  CHECK(neighbours_in(axis, -1).high == 0);
  CHECK(neighbours_in(axis, 5).low == 2);
  const Neighbours inside = neighbours_in(axis, 2.5);
  CHECK(inside.low == 1);
  CHECK(inside.weight == 0.75);
  CHECK(neighbours_in({2.0f}, 7).high == 0);
}
