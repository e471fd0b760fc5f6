// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/cell_reading.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "tabulated/lookup_grid.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr std::array<std::size_t, 3> nodes{4, 3, 5}, stride{15, 5, 1};

template <class T>
std::vector<T> random_memory(std::size_t channels, double unknown_share, test::Random& random) {
  std::vector<T> out(nodes[0] * nodes[1] * nodes[2] * channels + NodeMemory<T>::spare);
  for (T& stored : out) {
    const auto value = test::uniform(random, 0, 1) < unknown_share ? std::numeric_limits<float>::quiet_NaN()
                                                                   : static_cast<float>(test::uniform(random, -3, 50));
    if constexpr (std::is_same_v<T, float>)
      stored = value;
    else
      stored = half_from(value);
  }
  return out;
}

float number(float value) { return value; }
float number(std::uint16_t half) { return float_from(half); }

bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b); }

/// As the header says, one number after the other: between the corners, and the mean of those that are known.
struct Expected {
  float between, known_mean;
};
template <class T>
Expected expected(const std::vector<T>& memory, std::size_t channels, const Cells& cells, std::size_t k, std::size_t channel) {
  float v[8], weight[8], sum = 0, weights = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::size_t node = cells.node[k];
    weight[corner] = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool high = (corner >> (2 - axis) & 1) != 0;
      node += high ? stride[axis] : 0;
      weight[corner] *= high ? cells.weight[axis][k] : 1 - cells.weight[axis][k];
    }
    v[corner] = number(memory[node * channels + channel]);
    if (std::isnan(v[corner]) || !(weight[corner] > 0)) continue;
    sum += weight[corner] * v[corner], weights += weight[corner];
  }
  for (std::size_t half = 4, axis = 0; half > 0; half /= 2, ++axis)
    for (std::size_t corner = 0; corner < half; ++corner) v[corner] += cells.weight[axis][k] * (v[corner + half] - v[corner]);
  return {v[0], sum / weights};
}

template <class T>
void check_reading() {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (const std::size_t channels : {1u, 2u, 3u, 4u, 9u})
    for (const double unknown_share : {0.0, 0.1, 1.0}) {
      const std::vector<T> values = random_memory<T>(channels, unknown_share, random);
      const NodeMemory<T> memory{values.data(), channels, stride};
      for (const std::size_t count : {std::size_t{1}, std::size_t{7}, Cells::most}) {
        Cells cells;
        cells.count = count;
        for (std::size_t k = 0; k < count; ++k) {
          cells.node[k] = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto last = static_cast<double>(nodes[axis] - 1);
            cells.node[k] +=
                static_cast<std::uint32_t>(k == 0 ? last - 1 : test::uniform(random, 0, last)) * static_cast<std::uint32_t>(stride[axis]);
            cells.weight[axis][k] = k % 5 == 0 ? static_cast<float>(k % 2) : static_cast<float>(test::uniform(random, 0, 1));
          }
        }
        constexpr float untouched = -77;
        std::vector<float> linear(count * channels + 1, untouched), nearest(count * channels + 1, untouched);
        read_linear(memory, cells, linear.data());
        read_nearest(memory, cells, nearest.data());
        std::size_t wrong = 0;
        for (std::size_t k = 0; k < count; ++k) {
          bool known = true;
          for (std::size_t c = 0; c < channels; ++c) known = known && !std::isnan(expected(values, channels, cells, k, c).between);
          for (std::size_t c = 0; c < channels; ++c) {
            const Expected wanted = expected(values, channels, cells, k, c);
            wrong += same(linear[k * channels + c], known ? wanted.between : wanted.known_mean) ? 0 : 1;
            wrong += same(nearest[k * channels + c], number(values[cells.node[k] * channels + c])) ? 0 : 1;
          }
        }
        CHECK(wrong == 0);
        CHECK(linear.back() == untouched);
        CHECK(nearest.back() == untouched);
      }
    }
}

}  // namespace

TEST_CASE("Reading in vectors gives the bits of one number after the other, from floats and from halfs, and writes nothing beyond") {
  check_reading<float>();
  check_reading<std::uint16_t>();
}

TEST_CASE("A position that is nowhere gives NaN") {
  const std::vector<float> values(60 * 3 + NodeMemory<float>::spare, 2.0f);
  Cells cells;
  cells.count = 2;
  for (std::size_t axis = 0; axis < 3; ++axis) cells.node = {}, cells.weight[axis][0] = cells.weight[axis][1] = 0.5f;
  cells.weight[1][1] = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> out(6);
  read_linear(NodeMemory<float>{values.data(), 3, stride}, cells, out.data());
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(out[c] == 2);
    CHECK(std::isnan(out[3 + c]));
  }
}
