// SPDX-License-Identifier: BSD-3-Clause
// The run store: one SQLite file that keeps every reading raw. Acknowledged = committed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "acquisition/clock.hpp"
#include "acquisition/plan.hpp"
#include "acquisition/run_storage.hpp"

namespace gonio::acquisition {

/// One reading of the detector with the pose the drives reported. Nothing in it is corrected.
struct Reading {
  std::int64_t step = 0;
  int attempt = 0;
  int repeat = 0;      ///< 0 .. readings_at(kind, bench) - 1
  BenchTime time = 0;  ///< middle of the exposure
  double signal = 0;   ///< as the meter printed it [W]
  double exposure_s = 0, range_w = 0;
  std::vector<std::int64_t> counts;  ///< read-back position of each axis
  AxisAngles axes;                   ///< the same in degrees
  bool good = true;                  ///< false: saturated, out of position or otherwise refused, with a reason
  std::string reason;
};

struct RunEvent {
  BenchTime time = 0;
  std::string kind, text;
};

/// A `.gonio` file (WAL, synchronous FULL, one transaction per reading). Schema: data-schemas/run.sql.
/// While it is open for writing, `-wal` and `-shm` files stand beside it; closing folds them in, so that a finished run is one file.
/// Nothing of the machine or the time of day gets into it by itself: the same readings make the same bytes.
/// One writer at a time: a second one gets an Error(input).
class Run {
 public:
  /// Makes a new file holding bench, plan and every step. Error(input) if the file exists.
  static Run create(const std::filesystem::path& path, const Bench& bench, const PlanRequest& request, const SweepPlan& plan,
                    const RunStorage& storage = {});
  /// Opens an existing one; Error(input) if it is no run file.
  static Run open(const std::filesystem::path& path, bool writable = false, const RunStorage& storage = {});
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Committed when it returns. A second reading of the same (step, attempt, repeat) is an Error(internal).
  void append(const Reading& reading);
  void append(const RunEvent& event);
  void set_meta(const std::string& key, const std::string& value);

  Bench bench() const;
  PlanRequest request() const;
  std::vector<PlanStep> steps() const;
  std::vector<Reading> readings() const;  ///< in the order they were taken
  std::vector<RunEvent> events() const;
  std::map<std::string, std::string> meta() const;
  /// Steps that have a good reading for every repeat.
  std::set<std::int64_t> accepted_steps() const;

 private:
  struct Store;
  static void write_plan(const std::filesystem::path& path, const Bench& bench, const PlanRequest& request, const SweepPlan& plan,
                         const RunStorage& storage);
  explicit Run(std::unique_ptr<Store> store);
  std::unique_ptr<Store> store_;
};

}  // namespace gonio::acquisition
