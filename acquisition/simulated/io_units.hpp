// SPDX-License-Identifier: BSD-3-Clause
// The emulated I/O unit and the clock unit.
#pragma once

#include <algorithm>
#include <memory>

#include "acquisition/modbus/registers.hpp"
#include "acquisition/simulated/register_unit.hpp"

namespace gonio::acquisition::simulated {

/// Shutter, slide and a lamp that is always lit. Outputs act at once.
class IoUnit final : public RegisterUnit {
 public:
  IoUnit() : RegisterUnit(0, modbus::io_unit::count) { at(modbus::io_unit::lamp) = 1; }

  void refresh(BenchTime) override {}
  bool is_writable(int address) const override { return address == modbus::io_unit::shutter || address == modbus::io_unit::slide; }
  void written(int, int, BenchTime) override {}

  bool shutter_open() { return at(modbus::io_unit::shutter) == 1; }
  bool white_in_beam() { return at(modbus::io_unit::slide) == 1; }
};

/// Bench time, to be read and (if virtual) advanced by a client in another process, and the tag of the coming reading.
class ClockUnit final : public RegisterUnit {
 public:
  explicit ClockUnit(std::shared_ptr<Clock> clock) : RegisterUnit(0, modbus::clock_unit::count), clock_(std::move(clock)) {
    at(modbus::clock_unit::is_virtual) = clock_->is_virtual() ? 1 : 0;
  }

  void refresh(BenchTime now) override {
    std::ranges::copy(modbus::pack_time(now), at(modbus::clock_unit::time, modbus::clock_unit::time_count).begin());
  }
  bool is_writable(int address) const override {
    return address >= modbus::clock_unit::tag || (clock_->is_virtual() && address < modbus::clock_unit::time_count);
  }
  /// Time moves only when all four registers have been written at once, and never back.
  void written(int address, int count, BenchTime) override {
    if (address != modbus::clock_unit::time || count < modbus::clock_unit::time_count) return;
    clock_->sleep_until(
        modbus::unpack_time(at(modbus::clock_unit::time, modbus::clock_unit::time_count).first<modbus::clock_unit::time_count>()));
  }

  ReadingTag tag() {
    return modbus::unpack_tag(at(modbus::clock_unit::tag, modbus::clock_unit::tag_count).first<modbus::clock_unit::tag_count>());
  }

 private:
  std::shared_ptr<Clock> clock_;
};

}  // namespace gonio::acquisition::simulated
