// SPDX-License-Identifier: BSD-3-Clause
// The synthetic material of the figures: a half-vector lobe over a diffuse part, on a gantry's grid, with gain and read noise.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::test {

/// 9 incidences, 36 zenith angles and 36 azimuths: 11 664 pairs.
inline std::vector<GonioAngles> gantry_grid() {
  std::vector<GonioAngles> out;
  for (int i = 0; i < 9; ++i)
    for (int o = 0; o < 36; ++o)
      for (int p = 0; p < 36; ++p) out.push_back({degrees(10.0 * i), degrees(0), degrees(2.5 * o), degrees(10.0 * p)});
  return out;
}

/// ρd (.20, .15, .10), ρs .30 in every channel.
inline AnalyticBrdf ngan_material(double s) { return {"blinn-phong-ngan", rgb_channels(), {{.20, .30, s}, {.15, .30, s}, {.10, .30, s}}}; }

/// f (1 + 1 % N) + 1e-4 N', without any statement of uncertainty.
class NoisyReadings {
 public:
  NoisyReadings(const AnalyticBrdf& truth, std::vector<GonioAngles> angles) : angles_(std::move(angles)), channels_(truth.channels()) {
    exact_.resize(channels_.size());
    for (const GonioAngles& a : angles_) {
      const std::vector<double> f = truth.eval(a);
      for (std::size_t c = 0; c < f.size(); ++c) exact_[c].push_back(f[c]);
    }
  }
  /// `exact`: [channel][sample] 1/sr, where it is more than the model at the angles.
  NoisyReadings(std::vector<GonioAngles> angles, Channels channels, std::vector<std::vector<double>> exact)
      : angles_(std::move(angles)), channels_(std::move(channels)), exact_(std::move(exact)) {}
  std::shared_ptr<Dataset> draw(unsigned seed) const {
    auto data = std::make_shared<Dataset>();
    data->channels = channels_;
    data->angles = angles_;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (const std::vector<double>& exact : exact_) {
      std::vector<double> f;
      for (const double value : exact) {
        const double gain = normal(random), read = normal(random);
        f.push_back(value * (1 + .01 * gain) + 1e-4 * read);
      }
      data->f.push_back(std::move(f));
    }
    return data;
  }

 private:
  std::vector<GonioAngles> angles_;
  Channels channels_;
  std::vector<std::vector<double>> exact_;
};

}  // namespace gonio::test
