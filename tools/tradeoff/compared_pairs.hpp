// SPDX-License-Identifier: BSD-3-Clause
// The pairs of directions over which tables and files are held against the BRDF they were made of.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "brdf/brdf.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {

struct DirectionPairs {
  std::vector<Direction> wi, wo;
};

/// Both directions uniform in solid angle up to 80° from the normal; of every second pair wo lies within 15° of the mirror direction, where
/// the lobes are. The same in every run.
inline DirectionPairs compared_pairs(std::size_t count) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto direction = [&] {
    const double z = 1 - uniform() * (1 - degrees(80).cos()), phi = 2 * std::numbers::pi * uniform();
    return Direction::trusted(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
  };
  DirectionPairs out;
  while (out.wi.size() < count) {
    const Direction wi = direction();
    Direction wo = direction();
    if (out.wi.size() % 2 == 0) {
      const double part = 0.26 * uniform(), turn = 2 * std::numbers::pi * uniform();  // sin 15°
      wo = Direction::normalized(-wi.x() + part * std::cos(turn), -wi.y() + part * std::sin(turn), wi.z());
      if (wo.z() < degrees(80).cos()) continue;
    }
    out.wi.push_back(wi), out.wo.push_back(wo);
  }
  return out;
}

/// Mean of |value - truth|/truth over the pairs with a value, and the part of pairs without one. Both columns have n · stride values, of
/// which the first of each pair counts.
struct MeanError {
  std::optional<double> mean;  ///< none if no value is known
  double unknown = 0;
};
template <class T>
MeanError mean_relative_error(const std::vector<double>& truth, const std::vector<T>& value, std::size_t stride = 1) {
  double sum = 0, known = 0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    if (const double error = std::fabs(static_cast<double>(value[k * stride]) / truth[k] - 1); !std::isnan(error)) sum += error, known += 1;
  MeanError out;
  if (known > 0) out.mean = sum / known;
  out.unknown = 1 - known / static_cast<double>(truth.size());
  return out;
}

}  // namespace gonio::tools::tradeoff
