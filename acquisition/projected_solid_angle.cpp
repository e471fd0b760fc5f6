// SPDX-License-Identifier: BSD-3-Clause
// Projected solid angle of a disc that the horizon may cut.
#include <cmath>
#include <numbers>

#include "acquisition/reduce.hpp"

namespace gonio::acquisition {

// Lambert's contour form of ∫ n·ω dΩ = 1/2 ∮ n·(ω × dω). With d the centre of the disc and e(t) a unit circle around it,
// ω(t) = cos a d + sin a e(t) and n·(ω × ω') = sin² a cos θ + sin a cos a sin θ cos t; the arc above the horizon is
// cos t <= cot a cot θ, and the arc along the horizon itself adds its angle.
double projected_solid_angle(Angle theta, Angle half_angle) {
  constexpr double pi = std::numbers::pi;
  const double sin_a = half_angle.sin(), cos_a = half_angle.cos();
  const double sin_t = theta.sin(), cos_t = theta.cos();
  const double whole = pi * sin_a * sin_a * cos_t;
  if (theta.degrees() + half_angle.degrees() <= 90) return whole;
  if (theta.degrees() - half_angle.degrees() >= 90) return 0;
  const double cos_cut = cos_a * cos_t / (sin_a * sin_t);
  const double sin_cut = std::sqrt((1 - cos_cut) * (1 + cos_cut));
  const double cut = std::atan2(sin_cut, cos_cut);
  const double horizon = std::atan2(sin_a * sin_cut, cos_a * sin_t + sin_a * cos_t * cos_cut);
  return sin_a * sin_a * cos_t * (pi - cut) - sin_a * cos_a * sin_t * sin_cut + horizon;
}

}  // namespace gonio::acquisition
