// SPDX-License-Identifier: BSD-3-Clause
// Horizon, shadow of the head and spot against field.
#include "acquisition/pose_mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gonio::acquisition {
namespace {

/// Half angle of the cone about the retro direction in which the head cuts the beam.
double shadow_deg(const Bench& bench) {
  const double ratio = std::min(1.0, (bench.head_radius_m + bench.beam_radius_m) / bench.detector_distance_m);
  return angle_of(ratio, std::sqrt((1 - ratio) * (1 + ratio))).degrees() + bench.shadow_margin_deg;
}

/// True if the ellipse of the spot lies inside that of the field. A disc of diameter d seen along w covers the points x of the surface with
/// x'(I - t t')x <= d²/4, t the part of w in the surface; so the spot is inside iff (I - ti ti')/ds² - (I - to to')/df² has no negative
/// eigenvalue: trace and determinant are not negative.
bool spot_inside_field(double spot, double field, const Pose& pose) {
  if (spot == 0) return true;
  const Direction wi = pose.wi(), wo = pose.wo();
  const double q = (spot / field) * (spot / field);
  const double xx = (1 - wi.x() * wi.x()) - q * (1 - wo.x() * wo.x());
  const double yy = (1 - wi.y() * wi.y()) - q * (1 - wo.y() * wo.y());
  const double xy = -wi.x() * wi.y() + q * wo.x() * wo.y();
  return xx + yy >= 0 && xx * yy - xy * xy >= 0;
}

}  // namespace

std::optional<std::string> pose_mask(const Bench& bench, const Pose& pose) {
  if (pose.theta_i.cos() <= 0) return "the light is at or below the horizon of the sample";
  if (pose.theta_o.cos() <= 0) return "the detector is at or below the horizon of the sample";
  const double apart = angle_between(pose.wi(), pose.wo()).degrees(), shadow = shadow_deg(bench);
  if (apart < shadow)
    return fmt::format("the detector head shadows the beam: {:.2f}° from the retro direction, {:.2f}° needed", apart, shadow);
  const double spot = bench.apertures.spot_diameter_m.value_or(0), field = bench.apertures.field_diameter_m.value_or(0);
  if (!spot_inside_field(spot, field, pose))
    return fmt::format(
        "the spot exceeds the field: {:.1f} mm long at theta_i = {:g}°, field {:.1f} mm across and {:.1f} mm long at theta_o = {:g}°",
        1e3 * spot / pose.theta_i.cos(), pose.theta_i.degrees(), 1e3 * field, 1e3 * field / pose.theta_o.cos(), pose.theta_o.degrees());
  return std::nullopt;
}

}  // namespace gonio::acquisition
