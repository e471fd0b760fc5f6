// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/plane_sums.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio::fitting;
using gonio::test::Random;

namespace {

/// Planes one after the other, one byte off alignment.
struct Planes {
  std::vector<std::byte> bytes;
  std::vector<const std::byte*> first;
  std::size_t size;

  Planes(const std::vector<std::vector<double>>& values)
      : bytes(1 + values.size() * values[0].size() * sizeof(double)), size(values[0].size()) {
    for (std::size_t c = 0; c < values.size(); ++c) {
      std::byte* const at = bytes.data() + 1 + c * size * sizeof(double);
      std::memcpy(at, values[c].data(), size * sizeof(double));
      first.push_back(at);
    }
  }
};

/// Level with a spread of 1 %, and now and then what is no measurement.
std::vector<std::vector<double>> random_values(Random& random, std::size_t size, bool broken) {
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> out(3, std::vector<double>(size));
  for (std::size_t c = 0; c < 3; ++c)
    for (double& value : out[c]) {
      value = std::pow(10.0, static_cast<double>(c)) * (1 + 0.01 * normal(random));
      const double chance = gonio::test::uniform(random, 0, 1);
      if (chance < 0.05) value = -1;
      if (broken && chance > 0.98) value = NAN;
      if (broken && chance > 0.99) value = INFINITY;
    }
  return out;
}

}  // namespace

TEST_CASE("the sums of planes are those of two plain passes in long double, for every size and with holes") {
  Random random(gonio::test::seed);
  INFO("seed " << gonio::test::seed);
  for (const std::size_t size : {1u, 7u, 8u, 63u, 511u, 512u, 513u, 1000u, 16200u})
    for (const bool broken : {false, true})
      for (const bool drop_negative : {false, true}) {
        INFO("size " << size << ", broken " << broken << ", negative dropped " << drop_negative);
        const auto values = random_values(random, size, broken);
        const Planes planes(values);
        const SummedPlanes found = sum_planes(planes.first, size, drop_negative);
        std::vector<bool> sample(size, true);
        for (std::size_t k = 0; k < size; ++k)
          for (const auto& plane : values) sample[k] = sample[k] && !(drop_negative && plane[k] < 0);
        std::size_t used = 0, negative = 0, unknown = 0;
        for (std::size_t k = 0; k < size; ++k) {
          std::size_t finite = 0;
          for (const auto& plane : values) finite += std::isfinite(plane[k]) ? 1 : 0;
          used += sample[k] && finite > 0;
          negative += !sample[k];
          unknown += sample[k] && finite < values.size();
        }
        CHECK(found.used == used);
        CHECK(found.negative == negative);
        CHECK(found.unknown == unknown);
        for (std::size_t c = 0; c < values.size(); ++c) {
          long double count = 0, sum = 0, square = 0;
          double least = INFINITY, most = -INFINITY;
          const auto counts = [&](std::size_t k) { return sample[k] && std::isfinite(values[c][k]); };
          for (std::size_t k = 0; k < size; ++k)
            if (counts(k)) {
              count += 1, sum += values[c][k];
              least = std::min(least, values[c][k]), most = std::max(most, values[c][k]);
            }
          const long double mean = count > 0 ? sum / count : 0;
          for (std::size_t k = 0; k < size; ++k)
            if (counts(k)) square += (values[c][k] - mean) * (values[c][k] - mean);
          const PlaneSums& plane = found.plane[c];
          CHECK(plane.count == static_cast<double>(count));
          CHECK(plane.mean == Approx(static_cast<double>(mean)).epsilon(1e-14));
          CHECK(plane.within == Approx(static_cast<double>(square)).epsilon(1e-10).margin(1e-20));
          CHECK(plane.least == least);
          CHECK(plane.most == most);
        }
      }
}

TEST_CASE("a spread of a millionth is not lost beside the level") {
  Random random(gonio::test::seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(5000);
  for (double& value : values) value = 1e3 * (1 + 1e-6 * normal(random));
  long double mean = 0, square = 0;
  for (const double value : values) mean += value / 5000.0L;
  for (const double value : values) square += (value - mean) * (value - mean);
  const Planes planes({values});
  CHECK(sum_planes(planes.first, values.size(), true).plane[0].within == Approx(static_cast<double>(square)).epsilon(1e-9));
}
