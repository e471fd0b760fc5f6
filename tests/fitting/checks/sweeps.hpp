// SPDX-License-Identifier: BSD-3-Clause
// Sweeps and counts that the tests of several checks share.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "fitting/checks/checks.hpp"
#include "tests/fitting/synthetic.hpp"

namespace gonio::test {

using fitting::Check;
using fitting::CheckOptions;
using fitting::CheckSubject;

/// Every direction pair of a grid and its exchange.
inline std::vector<GonioAngles> pairs_of_directions() {
  std::vector<GonioAngles> directions, out;
  for (const double theta : {10., 25., 40., 55., 70.})
    for (double phi = 0; phi < 360; phi += 60) directions.push_back({degrees(theta), degrees(phi), {}, {}});
  for (const GonioAngles& i : directions)
    for (const GonioAngles& o : directions) out.push_back({i.theta_i, i.phi_i, o.theta_i, o.phi_i});
  return out;
}

/// The same poses relative to the plane of incidence at several azimuths of the sample.
inline std::vector<GonioAngles> turned_poses() {
  std::vector<GonioAngles> out;
  for (double turn = 0; turn < 360; turn += 30)
    for (const double theta_i : {20., 45., 70.})
      for (const double theta_o : {15., 50.})
        for (const double delta : {0., 60., 140., 180.})
          out.push_back({degrees(theta_i), degrees(turn), degrees(theta_o), degrees(turn + delta)});
  return out;
}

using Distortion = std::function<double(const GonioAngles&)>;

inline std::shared_ptr<Dataset> sweep(const std::vector<GonioAngles>& angles, const Noise& noise, unsigned seed,
                                      const Distortion& factor = {}) {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, 10);
  auto data = readings(truth, angles, noise, seed);
  if (factor)
    for (std::size_t k = 0; k < angles.size(); ++k) data->f[0][k] += truth.eval(angles[k])[0] * (factor(angles[k]) - 1);
  return data;
}

inline Check run(Check (*check)(const CheckSubject&, const CheckOptions&), std::shared_ptr<const Dataset> data) {
  return check({{std::move(data)}, nullptr, nullptr}, {});
}

inline constexpr int seeds = 300;
/// Of 300 correct data sets at a significance of 1 % more than 9 are refused with a probability below 0.2 %.
inline constexpr int most_refused = 9;
inline constexpr Noise percent{0, 0, 0.01};

inline int refused(Check (*check)(const CheckSubject&, const CheckOptions&), const std::vector<GonioAngles>& angles, const Noise& noise) {
  int count = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Check result = run(check, sweep(angles, noise, seed));
    count += result.p_value && *result.p_value < 0.01;
  }
  return count;
}

}  // namespace gonio::test
