// SPDX-License-Identifier: BSD-3-Clause
// Two arms over a turning sample: the kinematics of the Stanford spherical gantry.
#pragma once

#include <array>

#include "acquisition/kinematics.hpp"

namespace gonio::acquisition {

/// Four axes. In the bench's frame (z up, the sample in the plane z = 0) the light stands at zenith angle `light` in the xz plane, the
/// detector at zenith angle `detector_zenith` in the vertical plane of azimuth `detector_azimuth`; a negative zenith angle is the other
/// side of z. The sample is turned by `platform`, counter-clockwise seen from above, so azimuths in its frame are smaller by that much:
///   phi_i = azimuth(light) - platform,  phi_o = azimuth(detector) - platform.
/// Neither arm may come nearer to straight down than `bottom_stay_out_deg`, where the base stands.
class SphericalGantry final : public Kinematics {
 public:
  static constexpr std::array<const char*, 4> axis_names{"platform", "light", "detector_azimuth", "detector_zenith"};

  /// Error(input) unless the bench has these four axes in this order.
  explicit SphericalGantry(const Bench& bench);

  std::vector<AxisAngles> solutions(const Pose& pose, const AxisAngles* near = nullptr) const override;
  /// theta >= 0 and phi in (-180°, 180°], made from degrees: sums of read-back angles with no other rounding.
  Pose pose(const AxisAngles& axes) const override;
  std::optional<std::string> masked(const Pose& pose) const override;
  std::vector<std::size_t> incident_axes() const override { return {0, 1}; }
  std::string unreachable_reason(const Pose& pose) const override;

 private:
  Bench bench_;
};

}  // namespace gonio::acquisition
