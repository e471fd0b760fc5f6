// SPDX-License-Identifier: BSD-3-Clause
// Calibration readings in time: the mean of each visit and the straight line between visits.
#pragma once

#include <vector>

namespace gonio::acquisition {

struct Visit {
  double time_s = 0;
  double value = 0;
  double variance = 0;  ///< of `value`; NaN: unknown
};

/// Visits in the order of time, at least one. Before the first and after the last the nearest one holds.
class Visits {
 public:
  explicit Visits(std::vector<Visit> visits);

  double at(double time_s) const;
  /// Variance that all interpolated values share: that of the mean of all visits.
  double common_variance() const;
  /// What the value at this time varies more than that, by the noise of its own two visits; not negative.
  double local_variance(double time_s) const;
  /// Standard uncertainty of interpolating where the course is not straight: each inner visit against the line between its neighbours, less
  /// what their noise explains. That line is twice as long as the ones used, so a curved course is four times nearer to them.
  /// With two visits the course between them may be anything from the one to the other (rectangular, ± half the change); with one nothing
  /// is known: NaN.
  double straightness() const;
  const std::vector<Visit>& all() const { return visits_; }

  /// The visits a time lies between, and the share of the later one.
  struct Place {
    std::size_t before, after;
    double share;
  };
  Place place(double time_s) const;

 private:
  std::vector<Visit> visits_;
};

}  // namespace gonio::acquisition
