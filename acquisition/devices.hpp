// SPDX-License-Identifier: BSD-3-Clause
// The devices of a bench as the sweep engine sees them. The same contract test runs on every implementation.
#pragma once

#include <string>
#include <vector>

#include "acquisition/plan.hpp"

namespace gonio::acquisition {

/// What a reading is for; passed on to a bench that wants to know (the simulated one keys its noise by it).
struct ReadingTag {
  std::int64_t step = 0;
  StepKind kind = StepKind::sample;
  int attempt = 0;
  int repeat = 0;
};

struct AxisState {
  std::vector<std::int64_t> counts;
  AxisAngles degrees;
  bool in_position = false;
};

/// All axes of the bench. Absolute moves only. Every fault is an Error(device).
class Gantry {
 public:
  virtual ~Gantry() = default;
  /// Moves every axis, waits for in-position and settling, returns the read-back. Refuses targets outside the limits with Error(limit).
  virtual AxisState move_to(const AxisAngles& target) = 0;
  virtual AxisState read_back() = 0;
  /// Stops all axes; never throws; true only if every axis has been *seen* at rest.
  virtual bool stop() noexcept = 0;
};

/// What stands in the beam and whether there is a beam.
class Source {
 public:
  virtual ~Source() = default;
  virtual void open_shutter(bool open) = 0;
  virtual void present(StepKind kind) = 0;  ///< sample or reference under the beam (dark leaves it)
  virtual void announce(const ReadingTag& tag) = 0;
  /// Shutter closed, as far as it can be; never throws.
  virtual bool make_safe() noexcept = 0;
};

class Detector {
 public:
  virtual ~Detector() = default;
  virtual std::string identity() = 0;
  virtual void configure(double wavelength_nm, double range_w, double exposure_s) = 0;
  /// One reading [W] over the exposure; blocks until it is done. Over-range and device errors are Error(device).
  virtual double read(double exposure_s) = 0;
};

}  // namespace gonio::acquisition
