// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress_bar.hpp"

#include <fmt/format.h>

#include "tools/bench_source.hpp"

namespace gonio::tools {

ProgressBar::ProgressBar(const Console& console, std::string what, std::size_t total)
    : console_(console), what_(std::move(what)), begin_(Clock::now()), shown_(begin_), total_(total) {}

ProgressBar::~ProgressBar() {
  if (visible_) console_.progress("");
}

void ProgressBar::expect(std::size_t total) {
  const std::lock_guard lock(guard_);
  total_ = total;
}

void ProgressBar::advance(bool skipped, const std::string& note) {
  const std::lock_guard lock(guard_);
  ++done_;
  if (!skipped) ++worked_;
  show(note);
}

void ProgressBar::reach(std::size_t done, const std::string& note) {
  const std::lock_guard lock(guard_);
  done_ = worked_ = done;
  show(note);
}

void ProgressBar::show(const std::string& note) {
  const auto now = Clock::now();
  if (now - shown_ < console_.progress_interval()) return;
  shown_ = now;
  visible_ = true;
  console_.progress(progress_line(what_, done_, total_, worked_, std::chrono::duration<double>(now - begin_).count(), note));
}

std::string progress_line(const std::string& what, std::size_t done, std::size_t total, std::size_t worked, double elapsed_s,
                          const std::string& note) {
  constexpr std::size_t width = 20;
  const std::size_t filled = total > 0 ? done * width / total : width;
  const std::string left =
      worked > 0 ? duration_text(elapsed_s / static_cast<double>(worked) * static_cast<double>(total - done)) + " left" : "time unknown";
  return fmt::format("{} [{}{}] {} of {}, {}{}{}", what, std::string(filled, '#'), std::string(width - filled, '.'), done, total, left,
                     note.empty() ? "" : ", ", note);
}

}  // namespace gonio::tools
