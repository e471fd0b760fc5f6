// SPDX-License-Identifier: BSD-3-Clause
// Simulated sweeps with known noise for the tests of fits and checks.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::test {

/// Incidences times a polar grid of outgoing directions, theta_o up to 80°.
inline std::vector<GonioAngles> polar_grid(const std::vector<double>& theta_i_deg, double zenith_step_deg, double azimuth_step_deg,
                                           double phi_i_deg = 0) {
  std::vector<GonioAngles> out;
  for (const double theta_i : theta_i_deg)
    for (double theta_o = 0; theta_o <= 80; theta_o += zenith_step_deg)
      for (double phi_o = 0; phi_o < 360; phi_o += azimuth_step_deg) {
        out.push_back({degrees(theta_i), degrees(phi_i_deg), degrees(theta_o), degrees(phi_o)});
        if (theta_o == 0) break;
      }
  return out;
}

struct Noise {
  double read = 0;      ///< standard deviation that does not depend on f [1/sr]
  double shot = 0;      ///< variance per f [1/sr]
  double relative = 0;  ///< standard deviation as a part of f
};

/// Readings of a model, with the u an instrument would state: made from its own noisy reading. No noise at all: no u.
inline std::shared_ptr<Dataset> readings(const AnalyticBrdf& truth, const std::vector<GonioAngles>& angles, const Noise& noise,
                                         unsigned seed) {
  auto data = std::make_shared<Dataset>();
  data->channels = truth.channels();
  data->angles = angles;
  const std::size_t channels = truth.channels().size();
  data->f.resize(channels);
  const bool noisy = noise.read > 0 || noise.shot > 0 || noise.relative > 0;
  if (noisy) data->u.resize(channels);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (const GonioAngles& a : angles) {
    const std::vector<double> f = truth.eval(a);
    for (std::size_t c = 0; c < channels; ++c) {
      if (!noisy) {
        data->f[c].push_back(f[c]);
        continue;
      }
      const auto sigma = [&](double value) {
        const double positive = std::max(0.0, value);
        return std::sqrt(noise.read * noise.read + noise.shot * positive + noise.relative * noise.relative * f[c] * f[c]);
      };
      const double reading = f[c] + sigma(f[c]) * normal(random);
      data->f[c].push_back(reading);
      data->u[c].push_back(sigma(reading));
    }
  }
  if (noise.read > 0 && noise.shot > 0)
    for (std::size_t c = 0; c < channels; ++c)
      data->extra["var_read_" + truth.channels()[c].name] = std::vector<double>(angles.size(), noise.read * noise.read);
  return data;
}

inline AnalyticBrdf lobe(const std::string& model, double rho_d, double rho_s, double s) {
  return AnalyticBrdf(model, single_channel("Y"), {{rho_d, rho_s, s}});
}

}  // namespace gonio::test
