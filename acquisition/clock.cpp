// SPDX-License-Identifier: BSD-3-Clause
// The virtual clock's baton and the real clock.
#include "acquisition/clock.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace gonio::acquisition {

BenchTime bench_time(double s) noexcept { return static_cast<BenchTime>(std::ceil(s * static_cast<double>(second))); }

VirtualClock::VirtualClock(int members, BenchTime start) : members_(members), now_(start) {}

BenchTime VirtualClock::now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

void VirtualClock::pass_baton() {
  running_ = nobody;
  if (parked_.empty() || std::cmp_less(parked_.size(), members_)) return;
  const auto [wake, member] = *parked_.begin();
  parked_.erase(parked_.begin());
  now_ = std::max(now_, wake);
  running_ = member;
  turn_.notify_all();
}

void VirtualClock::sleep_until(BenchTime wake, int member) {
  std::unique_lock lock(mutex_);
  parked_.insert({wake, member});
  if (running_ == member || running_ == nobody) pass_baton();
  turn_.wait(lock, [&] { return running_ == member && !parked_.contains({wake, member}); });
}

void VirtualClock::leave(int member) {
  const std::lock_guard lock(mutex_);
  --members_;
  if (running_ == member || running_ == nobody) pass_baton();
}

RealClock::RealClock(BenchTime start) : epoch_(std::chrono::steady_clock::now() - std::chrono::nanoseconds(start)) {}

BenchTime RealClock::now() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - epoch_).count();
}

void RealClock::sleep_until(BenchTime wake, int) { std::this_thread::sleep_until(epoch_ + std::chrono::nanoseconds(wake)); }

}  // namespace gonio::acquisition
