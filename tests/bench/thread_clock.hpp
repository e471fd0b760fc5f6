// SPDX-License-Identifier: BSD-3-Clause
// Processor time of this thread alone: what other programs take does not count.
#pragma once

#include <ctime>

namespace gonio::bench {

inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace gonio::bench
