// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/total_scatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tabulated/specular_angles.hpp"

namespace gonio::tabulated {
namespace {

constexpr int azimuth_count = 180;
constexpr double first_panel_rad = 1e-4, widest_panel_rad = 0.2;

/// Nodes and weights of Gauss and Legendre's rule with 6 points on (-1, 1), Abramowitz and Stegun table 25.4, the positive half.
constexpr std::array<double, 3> gauss_nodes{0.238619186083196909, 0.661209386466264514, 0.932469514203152028};
constexpr std::array<double, 3> gauss_weights{0.467913934572691047, 0.360761573048138608, 0.171324492379170345};

}  // namespace

std::vector<double> total_scatter(const Brdf& brdf, Angle theta_i, Angle phi_i, Side side) {
  constexpr double step_rad = 2 * std::numbers::pi / azimuth_count;
  const std::size_t channel_count = brdf.channels().size();
  std::vector<double> sum(channel_count), f;
  std::vector<Direction> wi, wo;
  std::vector<double> weights;
  for (int a = 0; a < azimuth_count; ++a) {
    // Half a step off the plane of incidence, which no node then meets.
    const Angle azimuth = degrees((a + 0.5) * 360.0 / azimuth_count);
    const double end = radial_of_horizon(theta_i, azimuth).radians();
    wi.clear(), wo.clear(), weights.clear();
    for (double low = 0, width = first_panel_rad; low < end; low += width, width = std::min(2 * width, widest_panel_rad)) {
      const double half_width = std::min(width, end - low) / 2;
      for (std::size_t n = 0; n < 2 * gauss_nodes.size(); ++n) {
        const double node = n < gauss_nodes.size() ? gauss_nodes[n] : -gauss_nodes[n - gauss_nodes.size()];
        const Angle radial = radians(low + half_width * (1 + node));
        const GonioAngles angles = from_specular(theta_i, phi_i, {radial.degrees(), azimuth.degrees()}, side);
        wi.push_back(angles.wi()), wo.push_back(angles.wo());
        weights.push_back(step_rad * half_width * gauss_weights[n % gauss_nodes.size()] * radial.sin() * std::fabs(angles.theta_o.cos()));
      }
    }
    f.resize(wi.size() * channel_count);
    brdf.eval(wi, wo, f);
    for (std::size_t k = 0; k < wi.size(); ++k)
      for (std::size_t c = 0; c < channel_count; ++c)
        if (const double value = f[k * channel_count + c]; !std::isnan(value)) sum[c] += weights[k] * value;
  }
  return sum;
}

}  // namespace gonio::tabulated
