// SPDX-License-Identifier: BSD-3-Clause
// Values between scattered samples, as weights of the samples around.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "brdf/coordinates.hpp"
#include "fitting/checks/nearest_nodes.hpp"

namespace gonio::fitting {

/// Local linear regression (Cleveland 1979) over the nearest samples in (theta_i, wo relative to the plane of incidence), as many at
/// smaller as at larger theta_i, because a goniometer's grid is often fine in wo and coarse in theta_i: exact for what is linear there.
/// Only the difference of the azimuths counts, so the sample is taken for isotropic. Interpolate what is smooth: the ratio of f to a
/// fitted model, not f.
class LocalInterpolation {
 public:
  /// Samples at normal incidence have no plane of incidence and serve only for targets that have none either.
  explicit LocalInterpolation(const std::vector<GonioAngles>& angles);

  using Weights = std::vector<std::pair<std::size_t, double>>;
  /// Weights that sum to one; none where the target lies outside the samples, or further from them than six times their median spacing.
  /// `skip`: samples left out.
  std::optional<Weights> at(const GonioAngles& target, const NearestNodes::Skip& skip = {}) const;

 private:
  NearestNodes nodes_;
  double reach_ = 0;
};

}  // namespace gonio::fitting
