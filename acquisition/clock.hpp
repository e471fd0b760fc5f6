// SPDX-License-Identifier: BSD-3-Clause
// Bench time: motion, dwell, drift and stamps. Never used for the deadlines of sockets.
#pragma once

#include <cstdint>

namespace gonio::acquisition {

/// Nanoseconds of bench time since the run's epoch.
using BenchTime = std::int64_t;
constexpr BenchTime second = 1'000'000'000;

/// The clock of a bench, real or virtual. Virtual time is moved only by those who sleep.
/// A member is somebody who sleeps on its own (a bus owner, a detector): with several members time jumps to the earliest wake when
/// all are parked, and that one alone runs until it parks again, ties by member number.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual BenchTime now() const = 0;
  /// Parks the calling member until bench time `wake`; returns at once if that has passed.
  virtual void sleep_until(BenchTime wake, int member = 0) = 0;
  virtual bool is_virtual() const = 0;
};

}  // namespace gonio::acquisition
