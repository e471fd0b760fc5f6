// SPDX-License-Identifier: BSD-3-Clause
// Stated and estimated noise models.
#include "acquisition/meter_noise.hpp"

#include <cmath>
#include <random>

#include "tests/check.hpp"

using namespace gonio::acquisition;

namespace {

constexpr unsigned seed = 20260706;

std::vector<RepeatedReadings> visits(int count, int readings, double mean, double sd, double drift, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, sd);
  std::vector<RepeatedReadings> out;
  for (int v = 0; v < count; ++v) {
    RepeatedReadings visit{{}, 0.1};
    for (int k = 0; k < readings; ++k) visit.signals.push_back(mean + v * drift + noise(random));
    out.push_back(visit);
  }
  return out;
}

}  // namespace

TEST_CASE("a stated model is the sum of its parts") {
  const NoiseModel noise(MeterNoise{2e-10, 1e13, 6}, 1e-4);
  const double digit = 1e-12;  // sixth digit of 2e-7
  CHECK(noise.variance_without_shot(2e-7) == Approx(4e-20 + digit * digit / 12).epsilon(1e-12));
  CHECK(noise.shot_variance(2e-7, 0.1) == Approx(2e-7 / (1e13 * 0.1)).epsilon(1e-12));
  CHECK(noise.shot_variance(-1e-9, 0.1) == 0);
  CHECK(noise.origin() == "stated");
}

TEST_CASE("an ideal meter still has a last digit, at zero that of its range") {
  const NoiseModel noise(MeterNoise{std::nullopt, std::nullopt, 17}, 1e-3);
  CHECK(noise.variance(1e-7, 0.1) > 0);
  CHECK(std::sqrt(noise.variance(1e-7, 0.1)) < 1e-14 * 1e-7);
  CHECK(noise.variance(0, 0.1) > 0);
}

TEST_CASE("noise is estimated from the spread within visits, whatever drifts between them") {
  std::mt19937_64 random(seed);
  const double read = 1e-10, shot = std::sqrt(1e-7 / (1e13 * 0.1));
  const NoiseModel noise(visits(30, 20, 2e-9, read, 1e-9, random), visits(30, 20, 1e-7, std::hypot(read, shot), 1e-9, random));
  INFO("seed " << seed);
  CHECK(std::sqrt(noise.variance_without_shot(0)) == Approx(read).epsilon(0.1));
  CHECK(std::sqrt(noise.shot_variance(1e-7, 0.1)) == Approx(shot).epsilon(0.15));
  CHECK(noise.origin() == "estimated from repeated readings");
}

TEST_CASE("too few readings or none that scatter leave the noise unknown, never zero") {
  std::mt19937_64 random(seed);
  const auto few = visits(2, 2, 1e-7, 1e-10, 0, random), single = visits(30, 1, 1e-7, 1e-10, 0, random),
             still = visits(5, 5, 1e-7, 0, 0, random);
  const auto enough = visits(1, 5, 1e-7, 1e-10, 0, random);
  CHECK(std::isnan(NoiseModel(few, enough).variance(1e-7, 0.1)));
  CHECK(std::isnan(NoiseModel(enough, single).variance(1e-7, 0.1)));
  CHECK(std::isnan(NoiseModel(still, still).variance(1e-7, 0.1)));
  CHECK(NoiseModel(few, enough).origin() == "unknown");
  CHECK(NoiseModel(enough, enough).variance(1e-7, 0.1) > 0);
}
