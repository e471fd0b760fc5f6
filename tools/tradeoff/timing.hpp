// SPDX-License-Identifier: BSD-3-Clause
// The time of a piece of work: the median of several runs with the fastest and the slowest.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace gonio::tools::tradeoff {

/// Seconds for one piece of work.
struct Timing {
  double median_s = 0, least_s = 0, most_s = 0;
  int runs = 0;
};

inline Timing timing_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front(), seconds.back(), static_cast<int>(seconds.size())};
}

/// Times `work()`, which does `pieces` equal pieces and returns a double that keeps it from being optimised away. Short work is repeated
/// until a run takes `least_run_s`. The first, cold run is not counted.
template <class Work>
Timing time_of(Work&& work, std::size_t pieces, double least_run_s, int runs = 5) {
  using Clock = std::chrono::steady_clock;
  volatile double sink = 0;
  const auto run = [&](std::size_t repeats) {
    const auto start = Clock::now();
    for (std::size_t k = 0; k < repeats; ++k) sink = sink + work();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::size_t repeats = 1;
  while (run(repeats) < least_run_s) repeats *= 2;
  std::vector<double> seconds;
  for (int k = 0; k < runs; ++k) seconds.push_back(run(repeats) / static_cast<double>(repeats * pieces));
  return timing_of(std::move(seconds));
}

}  // namespace gonio::tools::tradeoff
