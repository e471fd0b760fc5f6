// SPDX-License-Identifier: BSD-3-Clause
// A bar with the time left, for work that is done in equal pieces.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "tools/console.hpp"

namespace gonio::tools {

/// Shows `what [#####.....] 45 of 100, 12 s left, note` on standard error as often as it is worth a line. Safe from several threads.
class ProgressBar {
 public:
  ProgressBar(const Console& console, std::string what, std::size_t total);
  ~ProgressBar();  ///< ends the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// There are more or fewer pieces than the constructor was told.
  void expect(std::size_t total);
  /// A piece is done; one that cost no work (`skipped`) does not shorten the time the others are expected to take.
  void advance(bool skipped = false, const std::string& note = {});
  /// So many of equally costly pieces are done now.
  void reach(std::size_t done, const std::string& note);

 private:
  void show(const std::string& note);

  using Clock = std::chrono::steady_clock;
  const Console& console_;
  const std::string what_;
  const Clock::time_point begin_;
  std::mutex guard_;
  Clock::time_point shown_;
  std::size_t total_, done_ = 0, worked_ = 0;
  bool visible_ = false;
};

/// The line itself: `done` of `total` pieces, `worked` of them in `elapsed_s`.
std::string progress_line(const std::string& what, std::size_t done, std::size_t total, std::size_t worked, double elapsed_s,
                          const std::string& note);

}  // namespace gonio::tools
