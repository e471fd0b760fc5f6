// SPDX-License-Identifier: BSD-3-Clause
// Golden-angle spiral around the specular direction.
#include "acquisition/density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio::acquisition {
namespace {

constexpr double grazing_deg = 85;                                  // lower than this a sample says little and the spot is long
constexpr double golden_angle_deg = 360 * (2 - std::numbers::phi);  // 137.5°
constexpr double nearer = 0.7;  // factor on the angle to the specular direction when both sides are too low

double thousandths(double degrees) { return std::round(degrees * 1000) / 1000; }

/// The direction at `apart` from the specular one (theta, 180°), `around` = 0 towards the horizon.
Direction beside_specular(Angle theta, Angle apart, Angle around) {
  const double towards = apart.sin() * around.cos(), across = apart.sin() * around.sin(), along = apart.cos();
  return Direction::trusted(-(along * theta.sin() + towards * theta.cos()), across, along * theta.cos() - towards * theta.sin());
}

}  // namespace

std::vector<Pose> specular_density(double theta_i_deg, int points, double width_deg) {
  const double theta = std::abs(theta_i_deg), lowest = std::max(grazing_deg, theta);
  const double exponent = std::log(width_deg / 90) / std::log(0.5);
  std::vector<Pose> out;
  for (int k = 0; k < points; ++k) {
    double apart = 90 * std::pow(static_cast<double>(k) / points, exponent), around = golden_angle_deg * k;
    Direction wo = beside_specular(degrees(theta), degrees(apart), degrees(around));
    for (bool other_side = false; wo.theta().degrees() > lowest && apart > 0; other_side = !other_side) {
      around += 180;
      if (other_side) apart *= nearer;
      wo = beside_specular(degrees(theta), degrees(apart), degrees(around));
      if (apart < 0.001) break;  // rounded to the specular direction itself
    }
    const double theta_o = std::min(thousandths(wo.theta().degrees()), lowest);
    out.push_back({degrees(theta), degrees(0), degrees(theta_o), degrees(theta_o == 0 ? 0 : thousandths(wo.phi().degrees()))});
  }
  return out;
}

}  // namespace gonio::acquisition
