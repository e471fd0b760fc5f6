// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/beta_offset.hpp"

#include <cmath>

namespace gonio::tabulated {

std::optional<GonioAngles> from_beta_offset(Angle theta_i, Angle phi_i, double length, Angle azimuth, Side side) {
  const double x = -theta_i.sin() * phi_i.cos() + length * azimuth.cos(), y = -theta_i.sin() * phi_i.sin() + length * azimuth.sin();
  const double sine = std::hypot(x, y);
  if (sine >= 1) return std::nullopt;
  Angle theta = angle_of(sine, std::sqrt(1 - sine * sine));
  if (side == Side::transmission) theta = degrees(180) - theta;
  return GonioAngles{theta_i, phi_i, theta, angle_of(y, x)};
}

BetaOffset to_beta_offset(const Direction& wi, const Direction& wo) {
  const double x = wo.x() + wi.x(), y = wo.y() + wi.y();
  const double azimuth = std::remainder(angle_of(y, x).degrees() - wi.phi().degrees() - 180, 360.0);
  return {std::hypot(x, y), azimuth < 0 ? azimuth + 360 : azimuth};
}

}  // namespace gonio::tabulated
