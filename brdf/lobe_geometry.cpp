// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/lobe_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "brdf/lobe_kernels.hpp"

namespace gonio {
namespace {

Vector3<double> vector(const Direction& w) { return {w.x(), w.y(), w.z()}; }

/// What follows from |h_xy|² and h_z of the unnormalised half vector: tan² theta_h = |h_xy|² / h_z².
void set_half_vector(LobeGeometry& g, double beta2, double hz) noexcept {
  const double tan2 = beta2 / (hz * hz);
  const bool above = hz > 0 && tan2 <= std::numeric_limits<double>::max();
  g.tan2_h = above ? tan2 : 0;
  g.log_cos_h = above ? -0.5 * std::log1p(tan2) : LobeGeometry::no_lobe;
  g.beta_gap = std::sqrt(beta2);
  g.cos_d = std::min(1.0, 0.5 * std::sqrt(beta2 + hz * hz));
}

/// half(a - b) and half(a + b) without the cosines of the whole angle.
Angle half_difference(const Angle& a, const Angle& b) noexcept {
  return a.made_from_degrees() && b.made_from_degrees() ? degrees((a.degrees() - b.degrees()) / 2)
                                                        : radians((a.radians() - b.radians()) / 2);
}
Angle half_sum(const Angle& a, const Angle& b) noexcept {
  return a.made_from_degrees() && b.made_from_degrees() ? degrees((a.degrees() + b.degrees()) / 2)
                                                        : radians((a.radians() + b.radians()) / 2);
}

}  // namespace

LobeGeometry lobe_geometry(const GonioAngles& angles) noexcept {
  const Angle& a = angles.theta_i;
  const Angle& b = angles.theta_o;
  const Angle half_delta =
      half_difference(angles.phi_o, angles.phi_i);  // its cosine is the sine of half the distance from the mirror azimuth
  const Angle gap = half_difference(a, b);
  const double sines = a.sin() * b.sin(), off_plane = sines * half_delta.cos() * half_delta.cos();
  const double sin_difference = 2 * half_sum(a, b).cos() * gap.sin();
  const double hz = a.cos() + b.cos();
  LobeGeometry g;
  g.cos_i = a.cos();
  g.cos_o = b.cos();
  const double beta2 = sin_difference * sin_difference + 4 * off_plane;
  set_half_vector(g, beta2, hz);
  const double q = gap.sin() * gap.sin() + off_plane;  // sin²(psi/2)
  g.log_cos_psi = q < 0.5 ? std::log1p(-2 * q) : LobeGeometry::no_lobe;
  // sin²(half the angle between wi and wo), the azimuths compared with 0 instead of 180°
  const double q_retro = gap.sin() * gap.sin() + sines * half_delta.sin() * half_delta.sin();
  g.log_cos_retro = q_retro < 0.5 ? std::log1p(-2 * q_retro) : LobeGeometry::no_lobe;
  if (g.has_half_vector()) {
    g.slope_x = (a.sin() * angles.phi_i.cos() + b.sin() * angles.phi_o.cos()) / hz;
    g.slope_y = (a.sin() * angles.phi_i.sin() + b.sin() * angles.phi_o.sin()) / hz;
  }
  g.product_x = sines * (angles.phi_i.cos() * angles.phi_o.cos());
  g.product_y = sines * (angles.phi_i.sin() * angles.phi_o.sin());
  return g;
}

LobeGeometry lobe_geometry(const Direction& wi, const Direction& wo) noexcept {
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z();
  LobeGeometry g;
  g.cos_i = wi.z();
  g.cos_o = wo.z();
  set_half_vector(g, hx * hx + hy * hy, hz);
  g.log_cos_psi = log_cos_mirror(vector(wi), vector(wo));
  g.product_x = wi.x() * wo.x();
  g.product_y = wi.y() * wo.y();
  const double ex = wi.x() - wo.x(), ey = wi.y() - wo.y(), dz = wi.z() - wo.z();
  const double half_sin2_retro = (ex * ex + ey * ey + dz * dz) / 4, cos_retro = wi.z() * wo.z() + (g.product_x + g.product_y);
  if (cos_retro > 0)
    g.log_cos_retro = half_sin2_retro < 0.25 ? std::log1p(-2 * half_sin2_retro) : std::log(cos_retro);
  else
    g.log_cos_retro = LobeGeometry::no_lobe;
  if (g.has_half_vector()) g.slope_x = hx / hz, g.slope_y = hy / hz;
  return g;
}

}  // namespace gonio
