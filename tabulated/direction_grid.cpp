// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_grid.hpp"

#include <cmath>

namespace gonio::tabulated {
namespace {

/// The nearest to the horizon that is sampled.
constexpr double last_theta_deg = 89;

struct Steps {
  double theta_i, theta_o;
  double phi, phi_near;         ///< away from the mirror direction and at it
  double turn_phi_i, turn_phi;  ///< of anisotropic sources
  double radial, ratio;
};

Steps steps_of(GridSize size) {
  switch (size) {
    case GridSize::paper: return {10, 5, 15, 2, 45, 15, 0.5, 1.25};
    case GridSize::standard: return {5, 2.5, 7.5, 1, 30, 5, 0.25, 1.15};
    case GridSize::fine: break;
  }
  return {2.5, 1.25, 5, 0.5, 15, 5, 0.1, 1.08};
}

std::vector<double> zenith_angles(double step) {
  std::vector<double> out;
  for (int k = 0; k * step < last_theta_deg; ++k) out.push_back(k * step);
  out.push_back(last_theta_deg);
  return out;
}

std::vector<double> full_turn(double step) {
  std::vector<double> out;
  for (int k = 0; k * step < 360; ++k) out.push_back(k * step);
  return out;
}

/// 0 to 180, each step towards 180 a little smaller than the one before where the wide steps end.
std::vector<double> half_turn(double wide, double near) {
  std::vector<double> from_mirror{0};
  constexpr double growth = 1.3;
  for (double step = near; step < wide; step *= growth) from_mirror.push_back(from_mirror.back() + step);
  // What is left is divided evenly.
  const double left = 180 - from_mirror.back();
  const int count = static_cast<int>(std::ceil(left / wide));
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(left * k / count);
  for (auto offset = from_mirror.rbegin(); offset != from_mirror.rend(); ++offset) out.push_back(180 - *offset);
  return out;
}

}  // namespace

std::vector<GonioAngles> DirectionGrid::pairs() const {
  std::vector<GonioAngles> out;
  out.reserve(size());
  for (const double theta_i : theta_i_deg)
    for (std::size_t i = 0; i < (theta_i == 0 ? 1 : phi_i_deg.size()); ++i)
      for (const double theta_o : theta_o_deg)
        for (std::size_t o = 0; o < (theta_o == 0 ? 1 : phi_deg.size()); ++o) {
          const double phi_o = phi_i_deg[i] + phi_deg[o];
          out.push_back({degrees(theta_i), degrees(phi_i_deg[i]), degrees(theta_o), degrees(phi_o < 360 ? phi_o : phi_o - 360)});
        }
  return out;
}

DirectionGrid direction_grid(GridSize size, const Symmetry& symmetry) {
  const Steps steps = steps_of(size);
  DirectionGrid out{zenith_angles(steps.theta_i), {0}, zenith_angles(steps.theta_o), {}};
  if (!symmetry.isotropic) {
    out.phi_i_deg = full_turn(steps.turn_phi_i);
    out.phi_deg = full_turn(steps.turn_phi);
    return out;
  }
  out.phi_deg = half_turn(steps.phi, steps.phi_near);
  if (!symmetry.bilateral)
    for (std::size_t k = out.phi_deg.size() - 2; k > 0; --k) out.phi_deg.push_back(360 - out.phi_deg[k]);
  return out;
}

std::vector<double> radial_grid_deg(GridSize size) {
  const Steps steps = steps_of(size);
  std::vector<double> out{0};
  for (double step = steps.radial; out.back() + step < 180; step *= steps.ratio) out.push_back(out.back() + step);
  out.push_back(180);
  return out;
}

}  // namespace gonio::tabulated
