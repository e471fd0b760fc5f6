// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/specular_angles.hpp"

#include <cmath>

namespace gonio::tabulated {
namespace {

GonioAngles mirrored_at_surface(GonioAngles angles, Side side) {
  if (side == Side::transmission) angles.theta_o = degrees(180) - angles.theta_o;
  return angles;
}

}  // namespace

GonioAngles from_specular(Angle theta_i, Angle phi_i, const SpecularAngles& node, Side side) {
  const double azimuth = std::remainder(node.azimuth_deg, 360.0);
  if (azimuth == 0 || std::fabs(azimuth) == 180) {
    // Zenith angle in the plane of incidence, positive on the specular side.
    Angle zenith = theta_i + degrees(azimuth == 0 ? -node.radial_deg : node.radial_deg);
    bool specular_side = true;
    if (zenith.degrees() < 0) zenith = -zenith, specular_side = false;
    if (zenith.degrees() > 180) zenith = degrees(360) - zenith, specular_side = false;
    return mirrored_at_surface({theta_i, phi_i, zenith, specular_side ? phi_i + degrees(180) : phi_i}, side);
  }
  // In the frame whose x axis is the azimuth of wi: specular (-sin, 0, cos), towards the normal (cos, 0, sin), and y.
  const Angle radial = degrees(node.radial_deg), about = degrees(azimuth);
  const double along = radial.cos(), towards = radial.sin() * about.cos(), across = radial.sin() * about.sin();
  const double x = -along * theta_i.sin() + towards * theta_i.cos(), z = along * theta_i.cos() + towards * theta_i.sin();
  return mirrored_at_surface({theta_i, phi_i, angle_of(std::hypot(x, across), z), phi_i + angle_of(across, x)}, side);
}

SpecularAngles to_specular(const Direction& wi, const Direction& wo, Side side) {
  const double sin_i = std::hypot(wi.x(), wi.y()), cos_i = wi.z();
  const double c = sin_i > 0 ? wi.x() / sin_i : 1, s = sin_i > 0 ? wi.y() / sin_i : 0;
  const double x = c * wo.x() + s * wo.y(), y = c * wo.y() - s * wo.x(), z = side == Side::transmission ? -wo.z() : wo.z();
  const double along = -x * sin_i + z * cos_i, towards = x * cos_i + z * sin_i;
  const double azimuth = angle_of(y, towards).degrees();
  return {angle_of(std::hypot(towards, y), along).degrees(), azimuth < 0 ? azimuth + 360 : azimuth};
}

Angle radial_of_horizon(Angle theta_i, Angle azimuth) {
  // cos theta_o = cos r cos theta_i + sin r cos a sin theta_i.
  return angle_of(theta_i.cos(), -theta_i.sin() * azimuth.cos());
}

}  // namespace gonio::tabulated
