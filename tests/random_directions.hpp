// SPDX-License-Identifier: BSD-3-Clause
// Seeded random geometry for property tests.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "brdf/coordinates.hpp"

namespace gonio::test {

constexpr unsigned seed = 20260701;  ///< printed by INFO in every test that draws

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

/// A direction of the upper hemisphere, uniform in solid angle.
inline Direction upper_direction(Random& random) {
  const double z = uniform(random, 0.0, 1.0), phi = uniform(random, -std::numbers::pi, std::numbers::pi), r = std::sqrt(1 - z * z);
  return Direction::trusted(r * std::cos(phi), r * std::sin(phi), z);
}

/// Angles of the upper hemisphere in degrees, with a good share at grazing.
inline GonioAngles gonio_pair(Random& random) {
  const auto theta = [&] {
    return degrees(uniform(random, 0, 1) < 0.2 ? 90 - std::pow(10.0, uniform(random, -6, 0)) : uniform(random, 0, 90));
  };
  return {theta(), degrees(uniform(random, -180, 180)), theta(), degrees(uniform(random, -180, 180))};
}

}  // namespace gonio::test
