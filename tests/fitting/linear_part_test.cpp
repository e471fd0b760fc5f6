// SPDX-License-Identifier: BSD-3-Clause
// Bounded least squares meet the conditions of optimality, and ranges are those of the set they describe.
#include "fitting/linear_part.hpp"

#include <cmath>
#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

constexpr unsigned seed = 20261123;

SmallSystem random_system(std::mt19937_64& random, std::size_t n, bool upper) {
  std::normal_distribution<double> normal;
  SmallSystem out{Matrix(n, n), std::vector<double>(n), std::vector<double>(n, std::nan("")), {}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t row = 0; row <= k; ++row) out.r(row, k) = normal(random);
    out.rhs[k] = 2 * normal(random);
  }
  if (upper) out.lower.assign(n, -0.5), out.upper.assign(n, 0.7);
  return out;
}

double square(const SmallSystem& system, const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t row = 0; row < system.rhs.size(); ++row) {
    double residual = -system.rhs[row];
    for (std::size_t k = 0; k < x.size(); ++k) residual += system.r(row, k) * x[k];
    sum += residual * residual;
  }
  return sum;
}

/// Half the derivative of the square by x_k.
double slope(const SmallSystem& system, const std::vector<double>& x, std::size_t k) {
  double sum = 0;
  for (std::size_t row = 0; row < system.rhs.size(); ++row) {
    double residual = -system.rhs[row];
    for (std::size_t j = 0; j < x.size(); ++j) residual += system.r(row, j) * x[j];
    sum += system.r(row, k) * residual;
  }
  return sum;
}

}  // namespace

TEST_CASE("a bounded solution lies within its bounds, and no allowed move lowers the square") {
  std::mt19937_64 random(seed);
  for (const bool upper : {false, true})
    for (std::size_t n = 1; n <= 7; ++n)
      for (int draw = 0; draw < 100; ++draw) {
        const SmallSystem system = random_system(random, n, upper);
        const Bounded found = solve_bounded(system);
        INFO("seed " << seed << ", n " << n << ", draw " << draw);
        REQUIRE(found.x.size() == n);
        CHECK(found.square == Approx(square(system, found.x)).margin(1e-12));
        for (std::size_t k = 0; k < n; ++k) {
          REQUIRE(found.x[k] >= system.low(k));
          REQUIRE(found.x[k] <= system.high(k));
          const double down = slope(system, found.x, k);
          if (found.x[k] > system.low(k)) CHECK(down < 1e-8);
          if (found.x[k] < system.high(k)) CHECK(down > -1e-8);
        }
      }
}

TEST_CASE("held values stay, dependent columns and columns of zeros are no obstacle") {
  SmallSystem system{Matrix(3, 3), {1, 2, 3}, {std::nan(""), 0.25, std::nan("")}, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) system.r(k, k) = 1;
  CHECK(solve_bounded(system).x == std::vector<double>{1, 0.25, 3});
  SmallSystem same{Matrix(2, 2), {2, 0}, {std::nan(""), std::nan("")}, {}, {}};
  same.r(0, 0) = same.r(0, 1) = 1;
  CHECK(solve_bounded(same).square == Approx(0).margin(1e-20));
  SmallSystem blind = same;
  blind.r(0, 1) = 0;
  CHECK(solve_bounded(blind).x == std::vector<double>{2, 0});
  CHECK(std::isinf(range_of(blind, 1, 1).high));
}

TEST_CASE("no point of the set lies outside the range of a parameter, and the ends are reached") {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-0.5, 0.7);
  for (int draw = 0; draw < 20; ++draw) {
    const SmallSystem system = random_system(random, 3, true);
    const double budget = solve_bounded(system).square + 0.5;
    const Range range = range_of(system, 1, budget);
    INFO("seed " << seed << ", draw " << draw);
    REQUIRE(!range.empty());
    for (int k = 0; k < 2000; ++k) {
      const std::vector<double> x{part(random), part(random), part(random)};
      if (square(system, x) > budget) continue;
      CHECK(x[1] >= range.low - 1e-12);
      CHECK(x[1] <= range.high + 1e-12);
    }
    for (const double end : {range.low, range.high}) {
      SmallSystem held = system;
      held.held[1] = end;
      CHECK(solve_bounded(held).square <= budget * (1 + 1e-9));
    }
  }
}

TEST_CASE("a column whose squares are denormal numbers takes nothing from the others") {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 200; ++draw) {
    Matrix block(16, 3);
    for (std::size_t row = 0; row < 16; ++row) {
      block(row, 0) = 1;
      block(row, 1) = std::exp(-373 + 0.02 * draw) * std::abs(normal(random));  // its square lies between 1e-324 and 1e-318
      block(row, 2) = normal(random);
    }
    const double wanted = length(block.column(2));
    Triangle triangle(3);
    triangle.add(block, 16);
    CHECK(length(triangle.r().column(2)) == Approx(wanted).epsilon(1e-13));
  }
}
