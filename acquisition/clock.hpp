// SPDX-License-Identifier: BSD-3-Clause
// Bench time: motion, dwell, drift and stamps. Never used for the deadlines of sockets.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>
#include <utility>

namespace gonio::acquisition {

/// Nanoseconds of bench time since the run's epoch.
using BenchTime = std::int64_t;
constexpr BenchTime second = 1'000'000'000;

/// Seconds as bench time, rounded to the next nanosecond above, so that whoever sleeps that long never wakes too early.
BenchTime bench_time(double seconds) noexcept;
/// Bench time in seconds.
constexpr double seconds(BenchTime time) noexcept { return static_cast<double>(time) / static_cast<double>(second); }

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

/// Time that passes only while every member sleeps: the same requests in the same order in every run, as fast as the machine can.
///
/// A member is a role, not a thread: a device that blocks its caller (a meter that is still exposing) sleeps in the caller's name.
/// With more than one member each has to begin with `sleep_until(0, member)`; the first who runs is then member 0.
/// The trap: a member that ends without `leave` stops time for all others.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(int members = 1, BenchTime start = 0);

  BenchTime now() const override;
  void sleep_until(BenchTime wake, int member = 0) override;
  bool is_virtual() const override { return true; }
  /// The member (it holds the baton) sleeps no more; the others go on without it.
  void leave(int member);

 private:
  void pass_baton();  // with mutex_ held

  mutable std::mutex mutex_;
  std::condition_variable turn_;
  std::set<std::pair<BenchTime, int>> parked_;
  int members_;
  int running_ = nobody;
  BenchTime now_;

  static constexpr int nobody = -1;
};

/// The steady clock of the machine, beginning at `start`.
class RealClock final : public Clock {
 public:
  explicit RealClock(BenchTime start = 0);

  BenchTime now() const override;
  void sleep_until(BenchTime wake, int member = 0) override;
  bool is_virtual() const override { return false; }

 private:
  std::chrono::steady_clock::time_point epoch_;
};

}  // namespace gonio::acquisition
