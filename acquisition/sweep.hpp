// SPDX-License-Identifier: BSD-3-Clause
// The sweep engine: takes a plan to a bench and keeps every reading.
#pragma once

#include <atomic>
#include <functional>

#include "acquisition/devices.hpp"
#include "acquisition/run.hpp"

namespace gonio::acquisition {

struct SweepProgress {
  std::size_t done = 0, total = 0;
  double bench_s = 0;      ///< bench time so far
  double eta_bench_s = 0;  ///< predicted bench time to the end
  double eta_wall_s = 0;   ///< predicted wall time to the end
};

struct SweepOptions {
  std::function<void(const SweepProgress&)> progress;
  const std::atomic<bool>* stop = nullptr;  ///< set by a signal handler: stop the arms, keep what was measured
  int attempts = 3;                         ///< attempts per step before the sweep gives up
};

struct SweepResult {
  std::size_t measured = 0, skipped = 0, masked = 0, retried = 0;
  double bench_s = 0;
};

/// Measures every ok step of the run that has no accepted reading yet. On any failure: shutter closed, all axes stopped (proved by
/// status), event recorded, then the Error goes on (device), or Error(interrupted) if `stop` was set.
SweepResult sweep(Run& run, const SweepPlan& plan, Gantry& gantry, Detector& detector, Source& source, Clock& clock,
                  const SweepOptions& options);

}  // namespace gonio::acquisition
