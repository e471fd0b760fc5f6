// SPDX-License-Identifier: BSD-3-Clause
// Pose of the sample frame <-> angles of the axes, and which poses a bench cannot measure.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/bench.hpp"
#include "acquisition/pose.hpp"

namespace gonio::acquisition {

/// Pure functions of the bench's shape. `pose(axis_angles(p)[k])` gives back p for every solution k (a property test).
class Kinematics {
 public:
  virtual ~Kinematics() = default;
  /// Every set of axis angles that realises the pose within the limits and outside the stay-out zones, best first: `near` first if given.
  virtual std::vector<AxisAngles> solutions(const Pose& pose, const AxisAngles* near = nullptr) const = 0;
  virtual Pose pose(const AxisAngles& axes) const = 0;
  /// The reason why a pose that could be driven to must not be measured (shadow of the head on the beam, spot beyond the field), or none.
  virtual std::optional<std::string> masked(const Pose& pose) const = 0;
  /// Axes that set the direction of the light in the frame of the sample: the outer loop of a sweep.
  virtual std::vector<std::size_t> incident_axes() const = 0;
  /// Why `solutions` is empty, naming axis, angle and limit.
  virtual std::string unreachable_reason(const Pose& pose) const = 0;
};

/// "spherical-gantry": two arms over a turning sample, 4 axes in this order: platform (azimuth of the sample), light (zenith angle in
/// the bench's xz plane, signed), detector_azimuth, detector_zenith (signed). Error(input) for an unknown name.
std::unique_ptr<Kinematics> make_kinematics(const Bench& bench);

}  // namespace gonio::acquisition
