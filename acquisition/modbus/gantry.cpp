// SPDX-License-Identifier: BSD-3-Clause
// Moves of all axes together: command, sleep to the predicted arrival, poll, settle; and the stop.
#include "acquisition/modbus/gantry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "acquisition/trapezoidal_motion.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {
namespace {

constexpr BenchTime arrival_poll = second / 100;      // between two looks at an axis that should have arrived
constexpr BenchTime stop_poll = second / 20;          // an axis that stands still over this long is at rest
constexpr BenchTime stop_patience = 10 * second;      // no arm needs longer to brake
constexpr BenchTime interrupt_latency = second / 20;  // on a real clock: how long a request to stop may be overlooked
constexpr double late_factor = 1.5, late_s = 2;       // a move is late after late_factor times its prediction plus late_s

}  // namespace

ModbusGantry::ModbusGantry(const Bench& bench, std::shared_ptr<Bus> bus, std::shared_ptr<Clock> clock, const std::atomic<bool>* stop)
    : bus_(std::move(bus)), clock_(std::move(clock)), commanded_(bench.axes.size()), stop_(stop) {
  drives_.reserve(bench.axes.size());
  for (const Axis& axis : bench.axes) {
    drives_.emplace_back(axis, *bus_, *clock_);
    settle_ = std::max(settle_, bench_time(axis.settle_s));
  }
  for (Drive& drive : drives_) drive.enable();
}

std::vector<Drive::State> ModbusGantry::states() {
  std::vector<Drive::State> states;
  states.reserve(drives_.size());
  for (Drive& drive : drives_) {
    states.push_back(drive.state());
    drive.require_no_fault(states.back());
  }
  return states;
}

AxisState ModbusGantry::result(const std::vector<Drive::State>& states) const {
  AxisState s;
  s.in_position = true;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    s.counts.push_back(states[k].position);
    s.degrees.push_back(drives_[k].axis().degrees(states[k].position));
    s.in_position = s.in_position && commanded_[k] && drives_[k].is_in_position(states[k], *commanded_[k]);
  }
  return s;
}

std::vector<std::int64_t> ModbusGantry::require_within_limits(const AxisAngles& target) const {
  if (target.size() != drives_.size()) {
    throw Error(ErrorKind::internal,
                Fault{"move", fmt::format("{} angles", target.size()), fmt::format("{}, one for each axis", drives_.size())});
  }
  std::vector<std::int64_t> counts;
  std::vector<Fault> faults;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    const Axis& axis = drives_[k].axis();
    if (target[k] >= axis.lower_deg && target[k] <= axis.upper_deg) {
      counts.push_back(axis.counts(target[k]));
    } else {
      faults.push_back({fmt::format("axis {}", axis.name), fmt::format("target {}°", target[k]),
                        fmt::format("{}° to {}°", axis.lower_deg, axis.upper_deg)});
    }
  }
  if (!faults.empty()) throw Error(ErrorKind::limit, "a move outside the limits was refused", std::move(faults));
  return counts;
}

void ModbusGantry::sleep_until(BenchTime wake) {
  for (;;) {
    if (stop_ && *stop_) throw Error(ErrorKind::interrupted, Fault{"move", "a request to stop", "no interruption"});
    const BenchTime now = clock_->now();
    if (now >= wake) return;
    clock_->sleep_until(clock_->is_virtual() ? wake : std::min(wake, now + interrupt_latency));
  }
}

AxisState ModbusGantry::move_to(const AxisAngles& target) {
  const std::vector<std::int64_t> counts = require_within_limits(target);
  if (last_.empty()) last_ = states();
  const std::vector<Drive::State> before = std::exchange(last_, {});

  // Command the axes that are not there yet: all targets first, then all starts.
  std::vector<std::size_t> moving;
  double predicted_s = 0;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    if (commanded_[k] == counts[k] && drives_[k].is_in_position(before[k], counts[k])) continue;
    const Axis& axis = drives_[k].axis();
    const double distance_deg = target[k] - axis.degrees(before[k].position);
    predicted_s = std::max(predicted_s, move_duration_s(distance_deg, axis.speed_deg_per_s, axis.acceleration_deg_per_s2));
    commanded_[k].reset();  // until the drive has acknowledged the new one
    drives_[k].set_target(counts[k]);
    moving.push_back(k);
  }
  for (const std::size_t k : moving) {
    drives_[k].start();
    commanded_[k] = counts[k];
  }
  const BenchTime arrival = clock_->now() + bench_time(predicted_s);
  sleep_until(arrival);
  last_ = wait_in_position(counts, arrival + bench_time((late_factor - 1) * predicted_s + late_s), moving.empty());
  return result(last_);
}

std::vector<Drive::State> ModbusGantry::wait_in_position(const std::vector<std::int64_t>& target, BenchTime deadline, bool is_settled) {
  for (;;) {
    std::vector<Drive::State> now = states();
    std::vector<Fault> late;
    for (std::size_t k = 0; k < drives_.size(); ++k) {
      if (drives_[k].is_in_position(now[k], target[k])) continue;
      late.push_back({fmt::format("{} (axis {})", bus_->where(drives_[k].axis().unit, drives_[k].axis().profile.position.address),
                                  drives_[k].axis().name),
                      fmt::format("position {}, status {:#06x}", now[k].position, now[k].status),
                      fmt::format("{} within {}° and the status bit of arrival", target[k], drives_[k].axis().tolerance_deg)});
    }
    if (late.empty()) {
      if (is_settled || settle_ == 0) return now;
      is_settled = true;
      sleep_until(clock_->now() + settle_);
      continue;
    }
    is_settled = false;
    if (clock_->now() >= deadline) throw Error(ErrorKind::device, "an axis did not come to rest at its target in time", std::move(late));
    sleep_until(clock_->now() + arrival_poll);
  }
}

AxisState ModbusGantry::read_back() {
  last_ = states();
  return result(last_);
}

bool ModbusGantry::stop() noexcept {
  // Every axis is told before any is looked at; one that does not answer must not keep the others from being told.
  last_.clear();
  bool told = true;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    try {
      commanded_[k].reset();
      drives_[k].stop();
    } catch (...) {
      told = false;
    }
  }
  try {
    const auto positions = [&] {
      std::vector<std::int64_t> p;
      for (Drive& drive : drives_) p.push_back(drive.state().position);
      return p;
    };
    const BenchTime deadline = clock_->now() + stop_patience;
    for (std::vector<std::int64_t> last = positions(); clock_->now() < deadline;) {
      clock_->sleep_until(clock_->now() + stop_poll);
      std::vector<std::int64_t> next = positions();
      if (next == last) return told;
      last = std::move(next);
    }
  } catch (...) {
    return false;
  }
  return false;
}

}  // namespace gonio::acquisition::modbus
