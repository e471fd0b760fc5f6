// SPDX-License-Identifier: BSD-3-Clause
// A Modbus unit of the simulated bench: holding registers over a device that is a pure function of its last commands and the time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/clock.hpp"

namespace gonio::acquisition::simulated {

class RegisterUnit {
 public:
  virtual ~RegisterUnit() = default;

  /// Brings `registers` up to date before they are read.
  virtual void refresh(BenchTime now) = 0;
  /// False refuses a write with the Modbus exception "illegal data address".
  virtual bool is_writable(int address) const = 0;
  /// Acts on registers that have been written.
  virtual void written(int address, int count, BenchTime now) = 0;

  int first() const { return first_; }
  std::vector<std::uint16_t>& registers() { return registers_; }

 protected:
  RegisterUnit(int first, int count) : first_(first), registers_(static_cast<std::size_t>(count)) {}
  std::uint16_t& at(int address) { return registers_[static_cast<std::size_t>(address - first_)]; }
  std::span<std::uint16_t> at(int address, int count) {
    return std::span(registers_).subspan(static_cast<std::size_t>(address - first_), static_cast<std::size_t>(count));
  }

 private:
  int first_;
  std::vector<std::uint16_t> registers_;
};

}  // namespace gonio::acquisition::simulated
