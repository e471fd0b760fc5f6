// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/coordinates.hpp"

#include <numbers>

namespace gonio {

GonioAngles gonio_angles(const Direction& wi, const Direction& wo) noexcept { return {wi.theta(), wi.phi(), wo.theta(), wo.phi()}; }

HalfDifference half_difference(const GonioAngles& angles) noexcept {
  // With a = theta_i, b = theta_o, D = phi_o - phi_i and axes turned to the mean azimuth m (s, c = sin, cos of D/2):
  //   h = wi + wo = ((sin a + sin b) c, (sin b - sin a) s, cos a + cos b)
  //   v = wi - wo = ((sin a - sin b) c, -(sin a + sin b) s, cos a - cos b)
  const Angle& a = angles.theta_i;
  const Angle& b = angles.theta_o;
  const Angle delta = angles.phi_o - angles.phi_i;
  const Angle half_delta = half(delta);
  const Angle mean = half(a + b), gap = half(a - b);
  const double s = half_delta.sin(), c = half_delta.cos();
  const double sin_difference = 2 * mean.cos() * gap.sin();   // sin a - sin b
  const double cos_difference = -2 * mean.sin() * gap.sin();  // cos a - cos b
  const double sin_sum = a.sin() + b.sin(), cos_sum = a.cos() + b.cos();
  const double hx = sin_sum * c, hy = -sin_difference * s;
  const double h_radius = std::hypot(hx, hy), h_length = std::hypot(h_radius, cos_sum);
  const double v_length = std::hypot(sin_difference * c, sin_sum * s, cos_difference);
  HalfDifference out;
  out.theta_h = angle_of(h_radius, cos_sum);
  out.phi_h = angles.phi_i + half_delta + angle_of(hy, hx);
  out.theta_d = angle_of(v_length, h_length);
  // v is perpendicular to h, so its component along e_theta is -v_z / sin theta_h; both components times |h_xy|:
  out.phi_d = angle_of(-2 * a.sin() * b.sin() * delta.sin(), -cos_difference * h_length);
  return out;
}

HalfDifference half_difference(const Direction& wi, const Direction& wo) noexcept {
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z();
  const double vx = wi.x() - wo.x(), vy = wi.y() - wo.y(), vz = wi.z() - wo.z();
  const double h_length = std::hypot(hx, hy, hz);
  return {angle_of(std::hypot(hx, hy), hz), angle_of(hy, hx), angle_of(std::hypot(vx, vy, vz), h_length),
          angle_of(hx * vy - hy * vx, -vz * h_length)};
}

DirectionPair directions(const HalfDifference& coordinates) noexcept {
  const Angle &theta_h = coordinates.theta_h, &phi_h = coordinates.phi_h, &theta_d = coordinates.theta_d, &phi_d = coordinates.phi_d;
  const auto rotate = [&](double x, double y, double z) {
    const double x1 = theta_h.cos() * x + theta_h.sin() * z;
    const double z1 = theta_h.cos() * z - theta_h.sin() * x;
    return Direction::trusted(phi_h.cos() * x1 - phi_h.sin() * y, phi_h.sin() * x1 + phi_h.cos() * y, z1);
  };
  const double dx = theta_d.sin() * phi_d.cos(), dy = theta_d.sin() * phi_d.sin(), dz = theta_d.cos();
  return {rotate(dx, dy, dz), rotate(-dx, -dy, dz)};
}

double fold_phi_d(double phi_d_radians) noexcept {
  constexpr double pi = std::numbers::pi;
  double folded = std::fmod(phi_d_radians, pi);
  if (folded < 0) folded += pi;
  return folded < pi ? folded : 0.0;
}

}  // namespace gonio
