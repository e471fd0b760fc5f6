// SPDX-License-Identifier: BSD-3-Clause
// Size and power of the reciprocity test, for a short run and a long one.
#pragma once

#include <numbers>
#include <random>

#include "tests/fitting/checks/sweeps.hpp"

namespace gonio::test {

/// Random direction pairs and their exchange at 1 % noise.
inline std::shared_ptr<Dataset> random_pairs(std::size_t pairs, double asymmetry, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<GonioAngles> angles;
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto zenith = [&] { return std::acos(1 - .9 * uniform(random)) * 180 / std::numbers::pi; };
    const GonioAngles a{degrees(zenith()), degrees(360 * uniform(random)), degrees(zenith()), degrees(360 * uniform(random))};
    angles.push_back(a);
    angles.push_back({a.theta_o, a.phi_o, a.theta_i, a.phi_i});
  }
  return sweep(angles, percent, seed + 1000000, [&](const GonioAngles& a) { return 1 + asymmetry * (a.theta_i.cos() - a.theta_o.cos()); });
}

/// Parts of the seeds at which the combined test and the directed test alone refuse at 5 %.
struct Refusals {
  double combined = 0, directed = 0;
};
inline Refusals refusals(double asymmetry, unsigned first, unsigned count) {
  Refusals out;
  CheckOptions options;
  options.alpha = 0.05;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const Check check = check_reciprocity({{random_pairs(3780, asymmetry, seed)}, nullptr, nullptr}, options);
    out.combined += (*check.p_value < options.alpha) / static_cast<double>(count);
    out.directed += (check.directed.at(0).p_value < options.alpha) / static_cast<double>(count);
  }
  return out;
}

}  // namespace gonio::test
