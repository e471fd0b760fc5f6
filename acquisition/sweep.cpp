// SPDX-License-Identifier: BSD-3-Clause
// The sweep: for each step move, expose, verify, store; and a safe end whatever happens.
#include "acquisition/sweep.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "brdf/error.hpp"

namespace gonio::acquisition {
namespace {

using Utc = std::chrono::system_clock;

/// Bench time of the run, also after a resume: stamps never go back.
class RunTime {
 public:
  /// On a virtual clock time goes on at the last stamp; on a real one it has gone on since the run's epoch.
  RunTime(Run& run, Clock& clock) : clock_(clock) {
    BenchTime last = 0;
    for (const Reading& r : run.readings()) last = std::max(last, r.time);
    for (const RunEvent& e : run.events()) last = std::max(last, e.time);
    const auto meta = run.meta();
    const auto epoch = meta.find("epoch_ns");
    if (epoch == meta.end()) {
      // A virtual run has no place in history: the same sweep gives the same file.
      const std::int64_t ns = clock.is_virtual() ? 0 : utc_ns() - clock.now();
      run.set_meta("clock", clock.is_virtual() ? "virtual" : "real");
      run.set_meta("epoch_ns", std::to_string(ns));
      run.set_meta("epoch_utc", fmt::format("{:%FT%TZ}", fmt::gmtime(static_cast<std::time_t>(ns / second))));
    } else if (clock.is_virtual()) {
      if (clock.now() < last) clock.sleep_until(last);
    } else {
      offset_ = std::max<BenchTime>(utc_ns() - std::stoll(epoch->second), last) - clock.now();
    }
  }
  BenchTime now() const { return clock_.now() + offset_; }

 private:
  static std::int64_t utc_ns() { return std::chrono::duration_cast<std::chrono::nanoseconds>(Utc::now().time_since_epoch()).count(); }

  Clock& clock_;
  BenchTime offset_ = 0;
};

/// What a step still lacks: for every repeat the next attempt, or none where a good reading is stored.
struct Outstanding {
  std::vector<std::optional<int>> next_attempt;
  bool is_complete() const {
    return std::ranges::none_of(next_attempt, [](const auto& a) { return a.has_value(); });
  }
};

class Sweep {
 public:
  Sweep(Run& run, const SweepPlan& plan, Gantry& gantry, Detector& detector, Source& source, Clock& clock, const SweepOptions& options)
      : run_(run),
        plan_(plan),
        gantry_(gantry),
        detector_(detector),
        source_(source),
        options_(options),
        bench_(run.bench()),
        time_(run, clock) {}

  SweepResult run() {
    const BenchTime begin = time_.now();
    try {
      measure_all();
      source_.open_shutter(false);
      run_.append(RunEvent{time_.now(), "end", fmt::format("{} steps measured", result_.measured)});
    } catch (...) {
      make_safe();
      throw;
    }
    result_.bench_s = seconds(time_.now() - begin);
    return result_;
  }

 private:
  void measure_all();
  Outstanding outstanding(const PlanStep& step) const;
  void measure(const PlanStep& step, Outstanding todo);
  bool take(const PlanStep& step, int attempt, int repeat);
  void report(std::size_t done, std::size_t total, BenchTime begin, std::chrono::steady_clock::time_point wall_begin,
              std::size_t measured) const;
  void make_safe() noexcept;
  void require_go_ahead() const {
    if (options_.stop && *options_.stop) throw Error(ErrorKind::interrupted, Fault{"sweep", "a request to stop", "no interruption"});
  }

  Run& run_;
  const SweepPlan& plan_;
  Gantry& gantry_;
  Detector& detector_;
  Source& source_;
  const SweepOptions& options_;
  Bench bench_;
  RunTime time_;
  SweepResult result_;
  std::map<std::pair<std::int64_t, int>, std::pair<int, bool>> stored_;  // (step, repeat) -> (last attempt, a good one is there)
};

Outstanding Sweep::outstanding(const PlanStep& step) const {
  Outstanding todo;
  for (int repeat = 0; repeat < readings_at(step.kind, bench_); ++repeat) {
    const auto found = stored_.find({step.number, repeat});
    if (found == stored_.end()) {
      todo.next_attempt.emplace_back(0);
    } else if (found->second.second) {
      todo.next_attempt.emplace_back(std::nullopt);
    } else {
      todo.next_attempt.emplace_back(found->second.first + 1);
    }
  }
  return todo;
}

void Sweep::measure_all() {
  for (const Reading& r : run_.readings()) {
    auto& [attempt, good] = stored_[{r.step, r.repeat}];
    attempt = std::max(attempt, r.attempt);
    good = good || r.good;
  }
  run_.append(RunEvent{time_.now(), stored_.empty() ? "start" : "resume", "detector " + detector_.identity()});
  detector_.configure(bench_.wavelength_nm, bench_.range_w, bench_.exposure_s);

  const auto is_ok = [](const PlanStep& s) { return s.state == StepState::ok; };
  const auto total = static_cast<std::size_t>(std::ranges::count_if(plan_.steps, is_ok));
  const BenchTime begin = time_.now();
  const auto wall_begin = std::chrono::steady_clock::now();
  for (const PlanStep& step : plan_.steps) {
    if (!is_ok(step)) {
      ++result_.masked;
      continue;
    }
    Outstanding todo = outstanding(step);
    if (todo.is_complete()) {
      ++result_.skipped;
    } else {
      require_go_ahead();
      measure(step, std::move(todo));
      ++result_.measured;
    }
    report(result_.measured + result_.skipped, total, begin, wall_begin, result_.measured);
  }
}

void Sweep::measure(const PlanStep& step, Outstanding todo) {
  gantry_.move_to(step.axes);
  source_.present(step.kind);
  source_.open_shutter(step.kind != StepKind::dark);
  for (int repeat = 0; repeat < static_cast<int>(todo.next_attempt.size()); ++repeat) {
    std::optional<int>& attempt = todo.next_attempt[static_cast<std::size_t>(repeat)];
    for (int tries = 1; attempt; ++tries, ++*attempt) {
      require_go_ahead();
      if (take(step, *attempt, repeat)) break;
      if (tries == options_.attempts) {
        throw Error(ErrorKind::device, Fault{fmt::format("step {} ({})", step.number, name(step.kind)),
                                             fmt::format("no good reading in {} attempts", tries), "a good reading"});
      }
      ++result_.retried;
      gantry_.move_to(step.axes);
    }
  }
}

/// One reading, stored whether good or not.
bool Sweep::take(const PlanStep& step, int attempt, int repeat) {
  Reading r;
  r.step = step.number;
  r.attempt = attempt;
  r.repeat = repeat;
  r.exposure_s = step.exposure_s;
  r.range_w = bench_.range_w;
  source_.announce({step.number, step.kind, attempt, repeat});
  const BenchTime before = time_.now();
  try {
    r.signal = detector_.read(step.exposure_s);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::device) throw;
    run_.append(RunEvent{time_.now(), "retry", fmt::format("step {} attempt {}: {}", step.number, attempt, e.what())});
    return false;
  }
  const BenchTime after = time_.now();
  r.time = before + (after - before) / 2;
  // The pose is what the drives report after the exposure; an arm that was pushed spoils the reading.
  AxisState state = gantry_.read_back();
  r.counts = std::move(state.counts);
  r.axes = std::move(state.degrees);
  r.good = state.in_position;
  if (!r.good) r.reason = "an axis left its position during the exposure";
  run_.append(r);
  return r.good;
}

void Sweep::report(std::size_t done, std::size_t total, BenchTime begin, std::chrono::steady_clock::time_point wall_begin,
                   std::size_t measured) const {
  if (!options_.progress) return;
  SweepProgress p;
  p.done = done;
  p.total = total;
  p.bench_s = seconds(time_.now() - begin);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_begin).count();
  const auto left = static_cast<double>(total - done);
  // The plan's own prediction until the first step of this sweep is measured, then the mean so far.
  p.eta_bench_s = measured ? p.bench_s / static_cast<double>(measured) * left : plan_.predicted_s * left / static_cast<double>(total);
  p.eta_wall_s = measured ? wall_s / static_cast<double>(measured) * left : 0;
  options_.progress(p);
}

/// Light off, arms stopped and seen at rest, and a record of why; nothing of it may hide the error that led here.
void Sweep::make_safe() noexcept {
  const bool closed = source_.make_safe();
  const bool at_rest = gantry_.stop();
  try {
    std::string why = "unknown";
    try {
      throw;
    } catch (const std::exception& e) {
      why = e.what();
    }
    run_.append(RunEvent{
        time_.now(), "stop",
        fmt::format("shutter {}, arms {}: {}", closed ? "closed" : "not seen closed", at_rest ? "at rest" : "not seen at rest", why)});
  } catch (...) {
  }
}

}  // namespace

SweepResult sweep(Run& run, const SweepPlan& plan, Gantry& gantry, Detector& detector, Source& source, Clock& clock,
                  const SweepOptions& options) {
  const std::vector<PlanStep> stored = run.steps();
  const auto same = [](const PlanStep& a, const PlanStep& b) {
    return a.number == b.number && a.kind == b.kind && a.state == b.state && a.axes == b.axes;
  };
  if (!std::ranges::equal(stored, plan.steps, same)) {
    throw Error(ErrorKind::input, Fault{"run file", fmt::format("{} steps of another plan", stored.size()), "the steps of this plan"});
  }
  return Sweep(run, plan, gantry, detector, source, clock, options).run();
}

}  // namespace gonio::acquisition
