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

constexpr BenchTime acknowledge_poll = second / 500;  // between two looks at a status word that has not changed yet

}  // namespace

Drive::Drive(const Axis& axis, Bus& bus, Clock& clock) : axis_(axis), bus_(bus), clock_(clock) {}

std::string Drive::where(int address) const { return fmt::format("{} (axis {})", bus_.where(axis_.unit, address), axis_.name); }

void Drive::write(const RegisterField& f, double quantity) {
  bus_.write(axis_.unit, f.address, pack(f.type, std::llround(quantity / f.scale), axis_.profile.high_word_first), f.function_code);
}

std::int64_t Drive::read(const RegisterField& f) {
  std::array<std::uint16_t, 2> registers{};
  bus_.read(axis_.unit, f.address, std::span(registers).first(static_cast<std::size_t>(f.registers())), f.function_code);
  return unpack(f.type, registers, axis_.profile.high_word_first);
}

Drive::State Drive::state() {
  const AxisProfile& p = axis_.profile;
  std::vector<std::uint16_t> block;
  if (p.poll) {
    block.resize(static_cast<std::size_t>(p.poll->count));
    bus_.read(axis_.unit, p.poll->address, block, p.poll->function_code);
  }
  const auto value = [&](const RegisterField& f) {
    if (!p.poll) return read(f);
    const auto offset = static_cast<std::size_t>(f.address - p.poll->address);
    return unpack(f.type, std::span(block).subspan(offset), p.high_word_first);
  };
  return {static_cast<std::uint16_t>(value(p.status)), static_cast<std::uint32_t>(value(p.error)), value(p.position)};
}

void Drive::require_no_fault(const State& state) const {
  const AxisProfile& p = axis_.profile;
  if (!p.fault.in(state.status)) return;
  throw Error(ErrorKind::device, Fault{where(p.error.address), p.alarm_text(state.error), "no fault"});
}

bool Drive::is_in_position(const State& state, std::int64_t target) const {
  const AxisProfile& p = axis_.profile;
  const double error = std::abs(static_cast<double>(state.position) * p.position.scale - static_cast<double>(target) * p.target.scale);
  return p.target_reached.in(state.status) && error <= axis_.tolerance_deg * axis_.counts_per_deg;
}

void Drive::run(const std::vector<CommandStep>& steps, bool wait) {
  const AxisProfile& p = axis_.profile;
  for (const CommandStep& step : steps) {
    if (step.field) {
      const RegisterField* f = p.written_field(*step.field);
      if (!f) {
        throw Error(ErrorKind::input,
                    Fault{"axis profile " + p.name, "a command that writes '" + *step.field + "'", "a field that can be written"});
      }
      write(*f, step.value * f->scale);
    }
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
  write(p.velocity, axis_.speed_deg_per_s * axis_.counts_per_deg);
  if (p.acceleration) write(*p.acceleration, axis_.acceleration_deg_per_s2 * axis_.counts_per_deg);
  if (p.fault.in(at_connect.status)) {
    const auto alarm = std::ranges::find(p.alarms, at_connect.error, &Alarm::code);
    if (alarm != p.alarms.end() && !alarm->resettable) require_no_fault(at_connect);
    run(p.fault_reset);
  }
  run(p.enable);
  const State enabled = state();
  require_no_fault(enabled);
  if (!p.enabled.in(enabled.status)) {
    throw Error(ErrorKind::device, Fault{where(p.status.address), fmt::format("status {:#06x} after enabling", enabled.status),
                                         fmt::format("bit {} {}", p.enabled.bit, p.enabled.set ? "set" : "clear")});
  }
}

void Drive::set_target(std::int64_t counts) { write(axis_.profile.target, static_cast<double>(counts) * axis_.profile.target.scale); }

void Drive::start() { run(axis_.profile.start); }

void Drive::stop() { run(axis_.profile.stop, false); }

}  // namespace gonio::acquisition::modbus
