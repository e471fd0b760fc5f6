// SPDX-License-Identifier: BSD-3-Clause
// The state machine and the motion of an emulated drive.
#include "acquisition/simulated/drive_unit.hpp"

#include <algorithm>
#include <cmath>

#include "acquisition/modbus/registers.hpp"
#include "acquisition/trapezoidal_motion.hpp"

namespace gonio::acquisition::simulated {
namespace {

using modbus::pack;
using modbus::unpack;

// Control word 6040h.
constexpr std::uint16_t new_set_point = 1 << 4, halt = 1 << 8;
// Status word 6041h.
constexpr std::uint16_t target_reached = 1 << 10, set_point_acknowledged = 1 << 12, remote = 1 << 9, voltage_enabled = 1 << 4;
constexpr std::int64_t profile_position_mode = 1;  // 6060h

std::vector<RegisterField> fields(const AxisProfile& p) {
  std::vector<RegisterField> f{p.status, p.error, p.position, p.control, p.mode, p.target, p.velocity};
  if (p.acceleration) f.push_back(*p.acceleration);
  return f;
}

int first_register(const AxisProfile& p) {
  int first = p.status.address;
  for (const RegisterField& f : fields(p)) first = std::min(first, f.address);
  return p.poll ? std::min(first, p.poll->address) : first;
}

int register_count(const AxisProfile& p) {
  int end = p.poll ? p.poll->address + p.poll->count : 0;
  for (const RegisterField& f : fields(p)) end = std::max(end, f.address + f.registers());
  return end - first_register(p);
}

bool covers(const RegisterField& f, int address) { return address >= f.address && address < f.address + f.registers(); }

}  // namespace

DriveUnit::DriveUnit(const Axis& axis, bool motion)
    : RegisterUnit(first_register(axis.profile), register_count(axis.profile)),
      axis_(axis),
      motion_(motion),
      speed_(axis.speed_deg_per_s * axis.counts_per_deg),
      acceleration_(axis.acceleration_deg_per_s2 * axis.counts_per_deg) {
  from_ = std::llround(static_cast<double>(axis.counts(0)) * axis.profile.target.scale);  // every axis wakes up at 0°
}

void DriveUnit::store(const RegisterField& field, std::int64_t value) {
  std::ranges::copy(pack(field.type, std::llround(static_cast<double>(value) / field.scale), axis_.profile.high_word_first),
                    at(field.address, field.registers()).begin());
}

std::int64_t DriveUnit::load(const RegisterField& field) {
  return std::llround(static_cast<double>(unpack(field.type, at(field.address, field.registers()), axis_.profile.high_word_first)) *
                      field.scale);
}

void DriveUnit::refresh(BenchTime now) {
  store(axis_.profile.status, status(now));
  store(axis_.profile.error, 0);
  store(axis_.profile.position, position(now));
}

bool DriveUnit::is_writable(int address) const {
  const AxisProfile& p = axis_.profile;
  return covers(p.control, address) || covers(p.mode, address) || covers(p.target, address) || covers(p.velocity, address) ||
         (p.acceleration && covers(*p.acceleration, address));
}

void DriveUnit::written(int address, int count, BenchTime now) {
  const AxisProfile& p = axis_.profile;
  if (address <= p.control.address && p.control.address < address + count) control(static_cast<std::uint16_t>(load(p.control)), now);
}

void DriveUnit::control(std::uint16_t word, BenchTime now) {
  // CiA 402-2, device control commands: the masks select bits 0-3 and 7.
  if ((word & 0x82) == 0x00) {  // disable voltage: the arm is held where it stands
    brake(now);
    state_ = State::switch_on_disabled;
  } else if ((word & 0x86) == 0x02) {  // quick stop
    if (state_ == State::operation_enabled) {
      brake(now);
      state_ = State::quick_stop_active;
    } else if (state_ != State::quick_stop_active) {
      state_ = State::switch_on_disabled;
    }
  } else if ((word & 0x87) == 0x06) {  // shutdown
    if (state_ == State::operation_enabled) brake(now);
    if (state_ != State::quick_stop_active) state_ = State::ready_to_switch_on;
  } else if ((word & 0x8f) == 0x07) {  // switch on, disable operation
    if (state_ == State::operation_enabled) brake(now);
    if (state_ == State::ready_to_switch_on || state_ == State::operation_enabled) state_ = State::switched_on;
  } else if ((word & 0x8f) == 0x0f) {  // enable operation
    if (state_ != State::switch_on_disabled) state_ = State::operation_enabled;
  }
  if (state_ == State::operation_enabled) {
    if (word & halt) {
      brake(now);
    } else if ((word & new_set_point) && !(control_ & new_set_point) && load(axis_.profile.mode) == profile_position_mode) {
      acknowledged_ = true;
      move_to(load(axis_.profile.target), now);
    }
  }
  if (!(word & new_set_point)) acknowledged_ = false;
  control_ = word;
}

void DriveUnit::move_to(std::int64_t target, BenchTime now) {
  from_ = position(now);
  start_ = now;
  distance_ = static_cast<double>(target - from_);
  braking_ = false;
  reached_ = true;
  speed_ = static_cast<double>(load(axis_.profile.velocity));
  if (axis_.profile.acceleration) acceleration_ = static_cast<double>(load(*axis_.profile.acceleration));
  duration_s_ = motion_ ? move_duration_s(distance_, speed_, acceleration_) : 0;
}

void DriveUnit::brake(BenchTime now) {
  if (!is_moving(now) || braking_) return;
  const double t = seconds(now - start_), speed = speed_at(distance_, speed_, acceleration_, t);
  const double sign = std::copysign(1.0, distance_);
  from_ = position(now);
  start_ = now;
  duration_s_ = speed / acceleration_;
  distance_ = std::round(sign * speed * duration_s_ / 2);
  braking_ = true;
  reached_ = false;
}

bool DriveUnit::is_moving(BenchTime now) const { return seconds(now - start_) < duration_s_; }

std::int64_t DriveUnit::position(BenchTime now) const {
  if (!is_moving(now)) return from_ + std::llround(distance_);
  const double t = seconds(now - start_), left = duration_s_ - t;
  if (braking_) return from_ + std::llround(distance_ * (1 - left * left / (duration_s_ * duration_s_)));
  return from_ + std::llround(moved_distance(distance_, speed_, acceleration_, t));
}

double DriveUnit::position_deg(BenchTime now) const {
  return axis_.degrees(std::llround(static_cast<double>(position(now)) / axis_.profile.position.scale));
}

std::uint16_t DriveUnit::status(BenchTime now) const {
  std::uint16_t word = remote | voltage_enabled;
  switch (state_) {
    case State::switch_on_disabled: word |= 0x40; break;
    case State::ready_to_switch_on: word |= 0x21; break;
    case State::switched_on: word |= 0x23; break;
    case State::operation_enabled: word |= 0x27; break;
    case State::quick_stop_active: word |= 0x07; break;
  }
  if (acknowledged_) word |= set_point_acknowledged;
  if ((reached_ || (control_ & halt)) && !is_moving(now)) word |= target_reached;
  return word;
}

}  // namespace gonio::acquisition::simulated
