// SPDX-License-Identifier: BSD-3-Clause
// An emulated SCPI power meter.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "acquisition/bench.hpp"
#include "acquisition/clock.hpp"

namespace gonio::acquisition::simulated {

/// SCPI-99 as far as a power meter needs it: short and long forms in any case, `;` with the path kept, `:` for the root, queries
/// of every setting, an error queue (-113 undefined header, -108/-109 parameters, -222 data out of range, -230 no data,
/// -410 query interrupted, -420 query unterminated, -350 overflow), 9.9E37 beyond the range, 9.91E37 for no number.
class PowerMeter {
 public:
  /// `signal_w(start, exposure_s)` is what a reading that began at `start` sees; NaN if it is not known.
  PowerMeter(const Bench& bench, std::shared_ptr<Clock> clock, std::function<double(BenchTime start, double exposure_s)> signal_w);

  /// Executes one line; the answers to its queries joined by `;`, or none. FETC? during an exposure waits on the clock.
  std::optional<std::string> execute(std::string_view line);
  /// The next command came before the answer had left: the answer is dropped and -410 is queued.
  void interrupted();
  /// The connection ended in the middle of a line: -420 is queued.
  void unterminated();

 private:
  struct Command;
  static const std::vector<Command>& commands();
  void raise(int code, const char* text);
  std::optional<std::string> execute_one(std::string_view header, std::string_view parameter, bool is_query);
  std::optional<double> number(std::string_view parameter, double minimum, double maximum);
  std::string fetch(std::unique_lock<std::mutex>& lock);
  std::string print(double value) const;
  void reset();

  Bench bench_;
  std::shared_ptr<Clock> clock_;
  std::function<double(BenchTime, double)> signal_w_;

  std::mutex mutex_;
  std::deque<std::string> errors_;
  double wavelength_nm_ = 0, range_w_ = 0;
  int samples_ = 1;
  struct Acquisition {
    BenchTime start;
    double exposure_s;
    std::optional<double> value;  ///< once it has been fetched
  };
  std::optional<Acquisition> acquisition_;
};

}  // namespace gonio::acquisition::simulated
