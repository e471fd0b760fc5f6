// SPDX-License-Identifier: BSD-3-Clause
// Data sets as a gonio-reflectometer would bring them home from a known BRDF.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"
#include "tests/random_directions.hpp"

namespace gonio::test {

/// Incidences by outgoing directions, all in degrees, phi_i = 0; isotropic.
struct Plan {
  std::vector<double> theta_i{10, 30, 50, 70};
  double theta_o_step = 5, theta_o_last = 80, phi_step = 10;
};

struct Noise {
  double relative = 0.01, absolute = 1e-4;  ///< standard deviations of f: of a part of it, and in 1/sr
  bool stated = true;                       ///< the data set carries u
};

/// One channel, normal noise of the seed.
inline std::shared_ptr<Dataset> measured(const AnalyticBrdf& truth, const std::vector<GonioAngles>& angles,
                                         const std::optional<Noise>& noise, Random& random) {
  auto out = std::make_shared<Dataset>();
  out->channels = single_channel("value");
  out->symmetry.isotropic = true;
  out->f.resize(1);
  if (noise && noise->stated) out->u.resize(1);
  std::normal_distribution<double> normal;
  for (const GonioAngles& a : angles) {
    const double f = truth.eval(a)[0], u = noise ? std::hypot(noise->relative * f, noise->absolute) : 0;
    out->angles.push_back(a);
    out->f[0].push_back(f + u * normal(random));
    if (noise && noise->stated) out->u[0].push_back(u);
  }
  return out;
}

inline std::vector<GonioAngles> planned(const Plan& plan) {
  std::vector<GonioAngles> out;
  for (const double theta_i : plan.theta_i)
    for (double theta_o = 0; theta_o < plan.theta_o_last + 1e-9; theta_o += plan.theta_o_step)
      for (double phi = -180; phi < 180 - 1e-9; phi += plan.phi_step) {
        out.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi)});
        if (theta_o == 0) break;
      }
  return out;
}

/// Scattered pairs, none closer than 10° to the horizon.
inline std::vector<GonioAngles> scattered(std::size_t count, Random& random) {
  std::vector<GonioAngles> out;
  while (out.size() < count) {
    const Direction wi = upper_direction(random), wo = upper_direction(random);
    if (wi.z() > 0.1736 && wo.z() > 0.1736) out.push_back(gonio_angles(wi, wo));
  }
  return out;
}

inline AnalyticBrdf model(const char* name, std::vector<double> values) {
  return AnalyticBrdf(name, single_channel("value"), {std::move(values)});
}

}  // namespace gonio::test
