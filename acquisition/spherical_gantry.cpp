// SPDX-License-Identifier: BSD-3-Clause
// Sums of azimuths, both signs of each zenith angle and full turns within the limits.
#include "acquisition/spherical_gantry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "acquisition/pose_mask.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition {
namespace {

enum { platform, light, detector_azimuth, detector_zenith };

/// In (-180, 180]; exact.
double turned_back(double degrees) {
  const double rest = std::remainder(degrees, 360.0);
  return rest == -180 ? 180 : rest;
}

/// (|theta|, phi) of a direction whose zenith angle may be negative.
struct Spherical {
  double theta, phi;
};
Spherical normal_form(Angle theta, Angle phi) {
  const double t = turned_back(theta.degrees());
  return t < 0 ? Spherical{-t, phi.degrees() + 180} : Spherical{t, phi.degrees()};
}

/// Every sign of the two zenith angles, azimuths in (-180°, 180°], limits not yet looked at.
std::vector<AxisAngles> branches(const Pose& pose) {
  const Spherical i = normal_form(pose.theta_i, pose.phi_i), o = normal_form(pose.theta_o, pose.phi_o);
  std::vector<AxisAngles> out;
  for (const int light_sign : {1, -1}) {
    if (light_sign < 0 && i.theta == 0) continue;
    const double light_azimuth = light_sign > 0 ? 0 : 180;
    for (const int detector_sign : {1, -1}) {
      if (detector_sign < 0 && o.theta == 0) continue;
      const double other_side = detector_sign > 0 ? 0 : 180;
      // The difference of azimuths first: it does not depend on how the sample is turned and must not take up its rounding.
      out.push_back({turned_back(light_azimuth - i.phi), light_sign * i.theta, turned_back(light_azimuth + (o.phi - i.phi) - other_side),
                     detector_sign * o.theta});
    }
  }
  return out;
}

struct Interval {
  double lower, upper;
};

Interval allowed(const Bench& bench, std::size_t axis) {
  const Axis& a = bench.axes[axis];
  if (axis != light && axis != detector_zenith) return {a.lower_deg, a.upper_deg};
  const double bottom = 180 - bench.bottom_stay_out_deg;
  return {std::max(a.lower_deg, -bottom), std::min(a.upper_deg, bottom)};
}

/// `angle` and its full turns within the interval; zenith angles do not turn.
std::vector<double> turns(double angle, const Interval& within, std::size_t axis) {
  if (axis == light || axis == detector_zenith)
    return angle >= within.lower && angle <= within.upper ? std::vector{angle} : std::vector<double>{};
  std::vector<double> out;
  for (double k = std::ceil((within.lower - angle) / 360); angle + 360 * k <= within.upper; ++k)
    if (angle + 360 * k >= within.lower) out.push_back(angle + 360 * k);
  return out;
}

}  // namespace

SphericalGantry::SphericalGantry(const Bench& bench) : bench_(bench) {
  std::vector<Fault> faults;
  if (bench_.axes.size() != axis_names.size())
    faults.push_back({"/axes", std::to_string(bench_.axes.size()) + " axes", "the four axes of a spherical gantry"});
  for (std::size_t k = 0; k < std::min(bench_.axes.size(), axis_names.size()); ++k)
    if (bench_.axes[k].name != axis_names[k])
      faults.push_back({fmt::format("/axes/{}/name", k), bench_.axes[k].name, std::string(axis_names[k])});
  if (!faults.empty()) throw Error(ErrorKind::input, "the axes do not make a spherical gantry", faults);
}

std::vector<AxisAngles> SphericalGantry::solutions(const Pose& pose, const AxisAngles* near) const {
  std::vector<AxisAngles> out;
  for (const AxisAngles& branch : branches(pose)) {
    std::vector<AxisAngles> partial{{}};
    for (std::size_t axis = 0; axis < branch.size(); ++axis) {
      std::vector<AxisAngles> longer;
      for (const double angle : turns(branch[axis], allowed(bench_, axis), axis))
        for (AxisAngles axes : partial) {
          axes.push_back(angle);
          longer.push_back(std::move(axes));
        }
      partial = std::move(longer);
    }
    out.insert(out.end(), partial.begin(), partial.end());
  }
  const auto cost = [&](const AxisAngles& axes) {
    double slowest = 0, sum = 0;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const double seconds = std::abs(axes[axis] - (near ? (*near)[axis] : 0)) / bench_.axes[axis].speed_deg_per_s;
      slowest = std::max(slowest, seconds);
      sum += seconds;
    }
    return std::pair(slowest, sum);
  };
  std::stable_sort(out.begin(), out.end(), [&](const AxisAngles& a, const AxisAngles& b) { return cost(a) < cost(b); });
  return out;
}

Pose SphericalGantry::pose(const AxisAngles& axes) const {
  const double light_azimuth = axes[light] < 0 ? 180 : 0, other_side = axes[detector_zenith] < 0 ? 180 : 0;
  return {degrees(std::abs(axes[light])), degrees(turned_back(light_azimuth - axes[platform])), degrees(std::abs(axes[detector_zenith])),
          degrees(turned_back(axes[detector_azimuth] + other_side - axes[platform]))};
}

std::optional<std::string> SphericalGantry::masked(const Pose& pose) const { return pose_mask(bench_, pose); }

std::string SphericalGantry::unreachable_reason(const Pose& pose) const {
  // Of all branches the one that is the least outside tells what a person would have to change.
  std::string reason;
  double least = std::numeric_limits<double>::infinity();
  for (const AxisAngles& branch : branches(pose)) {
    double outside = 0;
    std::string text;
    for (std::size_t axis = 0; axis < branch.size(); ++axis) {
      const Interval within = allowed(bench_, axis);
      if (!turns(branch[axis], within, axis).empty()) continue;
      const bool above = branch[axis] > within.upper;
      const double limit = above ? within.upper : within.lower;
      const bool bottom = limit != (above ? bench_.axes[axis].upper_deg : bench_.axes[axis].lower_deg);
      outside += std::abs(branch[axis] - limit);
      text += fmt::format("{}axis {}: {:g}° is {} its {} of {:g}°", text.empty() ? "" : "; ", bench_.axes[axis].name, branch[axis],
                          above ? "above" : "below", bottom ? "stay-out at the bottom" : "limit", limit);
    }
    if (outside < least) least = outside, reason = text;
  }
  return reason;
}

}  // namespace gonio::acquisition
