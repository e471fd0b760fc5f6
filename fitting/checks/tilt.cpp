// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/tilt.hpp"

#include <cmath>
#include <numbers>

namespace gonio::fitting {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double wide = 1 * degree;  // prior of the remaining tilt: wider than any mount's error, so that it restrains nothing
constexpr double step = 1e-5;        // radians, for central differences: a lobe of s = 1e6 is 1e-3 wide
constexpr double most_tilt = 5 * degree;
constexpr int iterations = 12;
constexpr double settled = 1e-3;  // of the standard uncertainty

/// Rodrigues' rotation about the axis n × z by the angle between n and z.
Direction turned_back(const Direction& d, double x, double y) {
  const double size = std::hypot(x, y);
  if (size == 0) return d;
  const double angle = std::atan(size), s = std::sin(angle), c = std::cos(angle);
  const double ax = y / size, ay = -x / size;
  const double along = (ax * d.x() + ay * d.y()) * (1 - c);
  return Direction::trusted(d.x() * c + ay * d.z() * s + ax * along, d.y() * c - ax * d.z() * s + ay * along,
                            d.z() * c + (ax * d.y() - ay * d.x()) * s);
}

/// The model at the angles of a reading for a tilt; NaN below the horizon.
double model_at(const Brdf& model, const Reading& reading, TiltFrame frame, double x, double y) {
  const GonioAngles seen = seen_by_tilted(reading.angles, frame, x, y);
  const Direction wi = seen.wi(), wo = seen.wo();
  return wi.z() > 0 && wo.z() > 0 ? model.eval(wi, wo)[reading.channel] : std::nan("");
}

}  // namespace

double Tilt::size_deg() const { return std::hypot(x_deg, y_deg); }
double Tilt::u_deg() const {
  const double size = size_deg();
  return size > 0 ? std::hypot(x_deg * u_x_deg, y_deg * u_y_deg) / size : std::hypot(u_x_deg, u_y_deg);
}

GonioAngles seen_by_tilted(const GonioAngles& angles, TiltFrame frame, double x_rad, double y_rad) {
  const Angle turn = frame == TiltFrame::plane_of_incidence ? angles.phi_i : degrees(0);
  const Direction wi = Direction::spherical(angles.theta_i, angles.phi_i - turn),
                  wo = Direction::spherical(angles.theta_o, angles.phi_o - turn);
  return gonio_angles(turned_back(wi, std::tan(x_rad), std::tan(y_rad)), turned_back(wo, std::tan(x_rad), std::tan(y_rad)));
}

std::optional<Tilt> estimate_tilt(const Contrasts& set, const Brdf& model, TiltFrame frame) {
  Tilt tilt;
  tilt.frame = frame;
  double x = 0, y = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    tilt.corrected = set;
    for (Reading& reading : tilt.corrected.readings) {
      const double upright = model_at(model, reading, frame, 0, 0), here = model_at(model, reading, frame, x, y);
      const bool known = upright > 0 && here > 0;
      const double ratio = known ? upright / here : 1;
      const double slope_x = (model_at(model, reading, frame, x + step, y) - model_at(model, reading, frame, x - step, y)) / (2 * step);
      const double slope_y = (model_at(model, reading, frame, x, y + step) - model_at(model, reading, frame, x, y - step)) / (2 * step);
      const bool sloped = known && std::isfinite(slope_x) && std::isfinite(slope_y);
      reading.f *= ratio, reading.u *= ratio;
      for (double& effect : reading.shared) effect *= ratio;
      reading.shared.push_back(sloped ? wide * slope_x * ratio : 0);
      reading.shared.push_back(sloped ? wide * slope_y * ratio : 0);
    }
    tilt.corrected.free_components = set.free_components + 2;
    const ContrastTest test = test_contrasts(tilt.corrected, 1, 0.5);
    if (test.amplitude.size() < 2) return std::nullopt;
    const std::size_t last = test.amplitude.size() - 1;
    const double dx = wide * test.amplitude[last - 1], dy = wide * test.amplitude[last];
    const double ux = wide * test.u_amplitude[last - 1], uy = wide * test.u_amplitude[last];
    x += dx, y += dy;
    if (!(std::hypot(x, y) < most_tilt)) return std::nullopt;
    tilt.x_deg = x / degree, tilt.y_deg = y / degree, tilt.u_x_deg = ux / degree, tilt.u_y_deg = uy / degree;
    if (std::abs(dx) < settled * ux && std::abs(dy) < settled * uy) return tilt;
  }
  return std::nullopt;
}

}  // namespace gonio::fitting
