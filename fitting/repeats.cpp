// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/repeats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gonio::fitting {
namespace {

constexpr double grid = 1e7;  // steps per unit: components of a direction nearer than that are the same

using Key = std::array<std::int32_t, 6>;

Key key_of(const GonioAngles& angles) {
  const Direction wi = angles.wi(), wo = angles.wo();
  const auto rounded = [](double x) { return static_cast<std::int32_t>(std::lround(x * grid)); };
  return {rounded(wi.x()), rounded(wi.y()), rounded(wi.z()), rounded(wo.x()), rounded(wo.y()), rounded(wo.z())};
}

}  // namespace

std::vector<RepeatedReadings> repeated_readings(const Observations& observations) {
  std::vector<std::pair<Key, std::size_t>> keys;
  std::size_t first = 0;
  std::vector<GonioAngles> angles;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    observations.angles(b, angles);
    for (std::size_t k = 0; k < block.size; ++k)
      if (block.valid(k)) keys.emplace_back(key_of(angles[k]), first + k);
    first += block.size;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<RepeatedReadings> out;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    while (end < keys.size() && keys[end].first == keys[begin].first) ++end;
    if (end - begin > 1) {
      RepeatedReadings same;
      for (std::size_t k = begin; k < end; ++k) same.push_back(keys[k].second);
      out.push_back(std::move(same));
    }
    begin = end;
  }
  return out;
}

}  // namespace gonio::fitting
