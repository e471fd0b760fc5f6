// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lookup_grid.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "tests/random_directions.hpp"
#include "tests/tabulated/faults_text.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

GridShape shape_of(std::size_t channels, AxisEnd last = AxisEnd::periodic) {
  return {{7, 5, 9}, {AxisEnd::clamped, AxisEnd::clamped, last}, channels};
}

std::vector<double> random_values(const GridShape& shape, double unknown_share, test::Random& random) {
  std::vector<double> out(shape.node_count() * shape.channels);
  for (double& value : out)
    value = test::uniform(random, 0, 1) < unknown_share ? unknown : std::pow(10.0, test::uniform(random, -4, 4)) - 0.01;
  return out;
}

struct Positions {
  std::array<std::vector<float>, 3> axis;
  GridCoordinates view() const { return {{axis[0], axis[1], axis[2]}}; }
};

Positions random_positions(std::size_t n, test::Random& random) {
  Positions out;
  for (auto& axis : out.axis)
    for (std::size_t k = 0; k < n; ++k) {
      const float x = static_cast<float>(test::uniform(random, -12, 24));
      // Nodes and what lies beyond them too, and now and then nonsense.
      axis.push_back(k % 997 == 0 ? std::numeric_limits<float>::quiet_NaN() : k % 991 == 0 ? 1e30f * x : k % 5 == 0 ? std::round(x) : x);
    }
  return out;
}

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b); }

}  // namespace

TEST_CASE("A batch gives the bits of one lookup after the other, in every storage, interpolation and number of channels") {
  test::Random random(test::seed);
  for (const std::size_t channels : {1u, 3u, 4u, 7u})
    for (const Storage storage : {Storage::f32, Storage::f16})
      for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::linear})
        for (const AxisEnd last : {AxisEnd::periodic, AxisEnd::clamped}) {
          const GridShape shape = shape_of(channels, last);
          const LookupGrid grid(shape, random_values(shape, 0.02, random), storage);
          const Positions at = random_positions(3001, random);
          std::vector<float> out(3001 * channels), one(channels);
          grid.lookup(at.view(), interpolation, out);
          std::size_t different = 0, known = 0;
          for (std::size_t k = 0; k < 3001; ++k) {
            grid.at({at.axis[0][k], at.axis[1][k], at.axis[2][k]}, interpolation, one);
            for (std::size_t c = 0; c < channels; ++c) {
              different += same_bits(out[k * channels + c], one[c]) ? 0 : 1;
              known += one[c] == one[c];
            }
          }
          INFO("seed " << test::seed);
          CHECK(different == 0);
          CHECK(known > 2700 * channels);
        }
}

TEST_CASE("Nodes are exact, a plane is reproduced between them, and a periodic axis goes round") {
  GridShape shape{{4, 3, 5}, {AxisEnd::clamped, AxisEnd::clamped, AxisEnd::clamped}, 1};
  std::vector<double> plane;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 5; ++k) plane.push_back(1 + 2 * i + 3 * j - 0.5 * k);
  const LookupGrid grid(shape, plane, Storage::f32);
  float out = 0;
  grid.at({1.25f, 0.5f, 3.75f}, Interpolation::linear, {&out, 1});
  CHECK(out == Approx(1 + 2.5 + 1.5 - 1.875).epsilon(1e-6));
  grid.at({9, -4, 2}, Interpolation::linear, {&out, 1});  // clamped
  CHECK(out == 1 + 6 + 0 - 1);
  grid.at({0.6f, 1.4f, 2.5f}, Interpolation::nearest, {&out, 1});
  CHECK(out == 1 + 2 + 3 - 1.5f);

  shape.end[2] = AxisEnd::periodic;
  const LookupGrid round(shape, plane, Storage::f32);
  round.at({0, 0, 4.5f}, Interpolation::linear, {&out, 1});
  CHECK(out == 0.5f * (1 - 2) + 0.5f * 1);
  float turned = 0;
  round.at({0, 0, -0.5f}, Interpolation::linear, {&turned, 1});
  CHECK(turned == out);
  round.at({0, 0, 14.5f}, Interpolation::linear, {&turned, 1});
  CHECK(turned == out);
}

TEST_CASE("Unknown nodes are left out of a mean and make it NaN only together") {
  const GridShape shape{{2, 2, 2}, {}, 1};
  const LookupGrid grid(shape, std::vector<double>{1, unknown, 3, unknown, unknown, unknown, unknown, unknown}, Storage::f32);
  float out = 0;
  grid.at({0.5f, 0.25f, 0.5f}, Interpolation::linear, {&out, 1});
  CHECK(out == Approx(0.75 * 1 + 0.25 * 3));
  grid.at({1, 0.5f, 0.5f}, Interpolation::linear, {&out, 1});
  CHECK(std::isnan(out));
}

TEST_CASE("Half numbers are those of IEEE 754: every one comes back, and floats go to the nearest, ties to even") {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = float_from(half);
    if (std::isnan(value))
      CHECK(std::isnan(float_from(half_from(value))));
    else
      CHECK(half_from(value) == half);
  }
  CHECK(half_from(1.0f) == 0x3c00);
  CHECK(half_from(1.0f + 0x1p-11f) == 0x3c00);      // a tie
  CHECK(half_from(1.0f + 3 * 0x1p-11f) == 0x3c02);  // the next tie, to even
  CHECK(half_from(65504.0f) == 0x7bff);
  CHECK(half_from(65519.996f) == 0x7bff);
  CHECK(half_from(65520.0f) == 0x7c00);
  CHECK(half_from(0x1p-24f) == 1);
  CHECK(half_from(0x1p-25f) == 0);
  CHECK(half_from(-2.0f) == 0xc000);
}

TEST_CASE("A grid that does not fit its numbers, or numbers that do not fit the storage, are refused") {
  const GridShape shape{{2, 2, 2}, {}, 1};
  const auto faults = [&](const GridShape& s, std::vector<double> values, Storage storage) {
    return test::faults_of([&] { LookupGrid(s, values, storage); });
  };
  CHECK(faults(shape, std::vector<double>(8, 1.0), Storage::f16).empty());
  CHECK_FALSE(faults(shape, std::vector<double>(7, 1.0), Storage::f32).empty());
  CHECK_FALSE(faults({{1, 2, 2}, {}, 1}, std::vector<double>(4, 1.0), Storage::f32).empty());
  CHECK_FALSE(faults({{2, 2, 2}, {}, 0}, {}, Storage::f32).empty());
  CHECK_FALSE(faults({{1u << 20, 1u << 20, 1u << 20}, {}, 1}, {}, Storage::f32).empty());
  std::vector<double> large(8, 1.0);
  large[5] = 70000;
  CHECK(faults(shape, large, Storage::f32).empty());
  CHECK(faults(shape, large, Storage::f16).find("node 5 of a grid|70000") != std::string::npos);
  large[5] = 1e39;
  CHECK_FALSE(faults(shape, large, Storage::f32).empty());
}
