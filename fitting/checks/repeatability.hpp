// SPDX-License-Identifier: BSD-3-Clause
// What can be said of contrasts when the data state no uncertainty: noise and all within a margin, or beyond it and beyond repeats.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/contrasts.hpp"

namespace gonio::fitting {

/// Relative scatter that is no violation, estimated from the data themselves.
struct Repeatability {
  double relative = 0;  ///< comparable with the median of the contrasts
  std::size_t n = 0;    ///< places it comes from
  std::string source;   ///< "readings repeated at the same place", ...
};

/// The median, the upper one of two; 0 of nothing.
double median_of(std::vector<double> values);

/// Median relative standard deviation of the readings of places that were measured at least three times. None without such places.
std::optional<Repeatability> repeated_readings(const std::vector<std::shared_ptr<const Dataset>>& datasets);

/// Median of the places' relative sizes |c|/scale, with limits from the scatter of its values over blocks of neighbouring places (Student),
/// because neighbours err together; and their rms weighted by f².
struct MedianEffect {
  double median = 0, lower = 0, upper = 0, u = 0, rms = 0;
  std::size_t n = 0;
};
MedianEffect median_effect(const Contrasts& set, double alpha);

/// The verdict without stated uncertainties. Noise can only enlarge the differences seen, so that `pass` needs no noise model: the upper
/// limit of the median and the rms lie within the margin. `fail` needs one: the lower limit exceeds the margin after the repeatability is
/// taken out in squares. Anything else is `vacuous`. The places listed are those that differ most; there are no p-values.
void judge_without_uncertainty(Check& check, const Contrasts& set, const std::optional<Repeatability>& repeatability,
                               const CheckSubject& subject, const CheckOptions& options, const std::string& tested);

}  // namespace gonio::fitting
