// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/misalignment.hpp"

#include <cmath>

namespace gonio::fitting {
namespace {

/// The direction seen from a frame whose z axis leans by (tilt_x, tilt_y): the least rotation that takes that axis to +z (Rodrigues).
Direction seen_from(const Direction& w, const Misalignment& m) noexcept {
  const double angle = std::hypot(m.tilt_x, m.tilt_y);
  if (!(angle > 0)) return w;
  // Axis k in the surface, at right angles to the lean; positive angle takes the leaning axis up to +z.
  const double kx = -m.tilt_y / angle, ky = m.tilt_x / angle, c = std::cos(angle), s = -std::sin(angle);
  const double along = (kx * w.x() + ky * w.y()) * (1 - c);
  const double x = w.x() * c + ky * w.z() * s + kx * along;
  const double y = w.y() * c - kx * w.z() * s + ky * along;
  const double z = w.z() * c + (kx * w.y() - ky * w.x()) * s;
  return Direction::trusted(x, y, z);
}

}  // namespace

LobeGeometry lobe_geometry(const GonioAngles& angles, const Misalignment& misalignment) noexcept {
  if (misalignment.none()) return gonio::lobe_geometry(angles);
  if (misalignment.tilt_x == 0 && misalignment.tilt_y == 0)
    return gonio::lobe_geometry({angles.theta_i, angles.phi_i, angles.theta_o, radians(angles.phi_o.radians() + misalignment.azimuth)});
  const Direction wo = Direction::spherical(angles.theta_o, radians(angles.phi_o.radians() + misalignment.azimuth));
  return gonio::lobe_geometry(seen_from(angles.wi(), misalignment), seen_from(wo, misalignment));
}

}  // namespace gonio::fitting
