// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/misalignment.hpp"

#include <cmath>

namespace gonio::fitting {
namespace {

/// The direction seen from a frame whose z axis leans by (tilt_x, tilt_y): the least rotation that takes that axis to +z (Rodrigues).
Direction seen_from(const Direction& w, const Misalignment& m) noexcept {
  const double angle = std::hypot(m.tilt_x, m.tilt_y);
  // Axis k in the surface, at right angles to the lean; positive angle takes the leaning axis up to +z.
  const double kx = -m.tilt_y / angle, ky = m.tilt_x / angle, c = std::cos(angle), s = -std::sin(angle);
  const double along = (kx * w.x() + ky * w.y()) * (1 - c);
  double x = w.x() * c + ky * w.z() * s + kx * along;
  double y = w.y() * c - kx * w.z() * s + ky * along;
  double z = w.z() * c + (kx * w.y() - ky * w.x()) * s;
  if (z < 0 && w.z() >= 0) {
    const double length = std::hypot(x, y);
    x /= length, y /= length, z = 0;
  }
  return Direction::trusted(x, y, z);
}

GonioAngles turned(const GonioAngles& angles, double azimuth) noexcept {
  if (azimuth == 0) return angles;
  return {angles.theta_i, radians(angles.phi_i.radians() - azimuth), angles.theta_o, radians(angles.phi_o.radians() - azimuth)};
}

bool upright(const Misalignment& m) noexcept { return !(std::hypot(m.tilt_x, m.tilt_y) > 0); }

}  // namespace

GonioAngles seen_by(const Misalignment& m, const GonioAngles& angles) noexcept {
  if (upright(m)) return turned(angles, m.azimuth);
  return turned(gonio_angles(seen_from(angles.wi(), m), seen_from(angles.wo(), m)), m.azimuth);
}

LobeGeometry lobe_geometry(const GonioAngles& angles, const Misalignment& m) noexcept {
  if (upright(m)) return gonio::lobe_geometry(turned(angles, m.azimuth));
  const auto seen = [&](const Direction& w) {
    const Direction upright_frame = seen_from(w, m);
    const double c = std::cos(m.azimuth), s = std::sin(m.azimuth);
    return Direction::trusted(c * upright_frame.x() + s * upright_frame.y(), c * upright_frame.y() - s * upright_frame.x(),
                              upright_frame.z());
  };
  return gonio::lobe_geometry(seen(angles.wi()), seen(angles.wo()));
}

}  // namespace gonio::fitting
