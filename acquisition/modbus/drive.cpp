// SPDX-License-Identifier: BSD-3-Clause
// Commands of a drive as lists of writes and waits.
#include "acquisition/modbus/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "acquisition/modbus/registers.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {
namespace {

constexpr int max_read_count = 125;                   // registers in one answer (Modbus application protocol V1.1b3, 6.3)
constexpr BenchTime acknowledge_poll = second / 500;  // between two looks at a status word that has not changed yet

bool is(const StatusBit& bit, std::uint16_t status) { return ((status >> bit.bit & 1) != 0) == bit.set; }

}  // namespace

Drive::Drive(const Axis& axis, Bus& bus, Clock& clock) : axis_(axis), bus_(bus), clock_(clock) {
  const AxisProfile& p = axis_.profile;
  int end = 0;
  block_ = p.status.address;
  for (const RegisterField& f : {p.status, p.error, p.position}) {
    block_ = std::min(block_, f.address);
    end = std::max(end, f.address + width(f.type));
  }
  block_count_ = end - block_;
}

std::int64_t Drive::counts(double degrees) const {
  return std::llround((degrees - axis_.zero_offset_deg) * axis_.sign * axis_.counts_per_deg);
}

double Drive::degrees(std::int64_t counts) const {
  return static_cast<double>(counts) / axis_.counts_per_deg * axis_.sign + axis_.zero_offset_deg;
}

std::string Drive::where(int address) const { return fmt::format("{} (axis {})", bus_.where(axis_.unit, address), axis_.name); }

const RegisterField& Drive::field(const std::string& name) const {
  const AxisProfile& p = axis_.profile;
  if (name == "control") return p.control;
  if (name == "mode") return p.mode;
  if (name == "target") return p.target;
  if (name == "velocity") return p.velocity;
  if (name == "acceleration" && p.acceleration) return *p.acceleration;
  throw Error(ErrorKind::input, Fault{fmt::format("axis profile {}", p.name), fmt::format("a command that writes '{}'", name),
                                      "control, mode, target, velocity or acceleration"});
}

void Drive::write(const RegisterField& f, std::int64_t value) {
  bus_.write(axis_.unit, f.address, pack(f.type, value, axis_.profile.high_word_first));
}

Drive::State Drive::state() {
  const AxisProfile& p = axis_.profile;
  std::array<std::uint16_t, max_read_count> registers{};
  const bool at_once = block_count_ <= max_read_count;
  if (at_once) bus_.read(axis_.unit, block_, std::span(registers).first(static_cast<std::size_t>(block_count_)));
  const auto value = [&](const RegisterField& f) {
    const auto n = static_cast<std::size_t>(width(f.type));
    if (!at_once) bus_.read(axis_.unit, f.address, std::span(registers).first(n));
    const auto offset = at_once ? static_cast<std::size_t>(f.address - block_) : 0;
    return unpack(f.type, std::span(registers).subspan(offset, n), p.high_word_first);
  };
  return {static_cast<std::uint16_t>(value(p.status)), static_cast<std::uint32_t>(value(p.error)), value(p.position)};
}

void Drive::require_no_fault(const State& state) const {
  const AxisProfile& p = axis_.profile;
  if (!is(p.fault, state.status)) return;
  const auto alarm = std::ranges::find(p.alarms, state.error, &Alarm::code);
  throw Error(ErrorKind::device, Fault{where(p.error.address),
                                       fmt::format("alarm {:#06x}: {}", state.error, alarm == p.alarms.end() ? "not in the profile's list" : alarm->text),
                                       "no alarm"});
}

bool Drive::is_in_position(const State& state, std::int64_t target) const {
  const double error_counts = std::abs(static_cast<double>(state.position - target));
  return is(axis_.profile.target_reached, state.status) && error_counts <= axis_.tolerance_deg * axis_.counts_per_deg;
}

void Drive::run(const std::vector<CommandStep>& steps, bool wait) {
  const AxisProfile& p = axis_.profile;
  for (const CommandStep& step : steps) {
    if (step.field) write(field(*step.field), step.value);
    if (!wait || !step.wait_mask) continue;
    const BenchTime deadline = clock_.now() + bench_time(step.timeout_s);
    for (;;) {
      const State s = state();
      if ((s.status & *step.wait_mask) == step.wait_value) break;
      if (&steps != &p.fault_reset) require_no_fault(s);
      if (clock_.now() >= deadline) {
        throw Error(ErrorKind::device,
                    Fault{where(p.status.address), fmt::format("status {:#06x} {} s after the command", s.status, step.timeout_s),
                          fmt::format("{:#06x} under the mask {:#06x}", step.wait_value, *step.wait_mask)});
      }
      clock_.sleep_until(clock_.now() + acknowledge_poll);
    }
  }
}

void Drive::enable() {
  const AxisProfile& p = axis_.profile;
  const State at_connect = state();
  write(p.velocity, std::llround(axis_.speed_deg_per_s * axis_.counts_per_deg));
  if (p.acceleration) write(*p.acceleration, std::llround(axis_.acceleration_deg_per_s2 * axis_.counts_per_deg));
  if (is(p.fault, at_connect.status)) {
    const auto alarm = std::ranges::find(p.alarms, at_connect.error, &Alarm::code);
    if (alarm != p.alarms.end() && !alarm->resettable) require_no_fault(at_connect);
    run(p.fault_reset);
  }
  run(p.enable);
  const State enabled = state();
  require_no_fault(enabled);
  if (!is(p.enabled, enabled.status)) {
    throw Error(ErrorKind::device, Fault{where(p.status.address), fmt::format("status {:#06x} after enabling", enabled.status),
                                         fmt::format("bit {} {}", p.enabled.bit, p.enabled.set ? "set" : "clear")});
  }
}

void Drive::set_target(std::int64_t counts) { write(axis_.profile.target, counts); }

void Drive::start() { run(axis_.profile.start); }

void Drive::stop() { run(axis_.profile.stop, false); }

}  // namespace gonio::acquisition::modbus
