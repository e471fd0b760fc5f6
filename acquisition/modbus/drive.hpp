// SPDX-License-Identifier: BSD-3-Clause
// One axis behind Modbus registers, driven as its profile says.
#pragma once

#include <cstdint>
#include <string>

#include "acquisition/bench.hpp"
#include "acquisition/clock.hpp"
#include "acquisition/modbus/bus.hpp"

namespace gonio::acquisition::modbus {

/// A drive in counts. It knows no other drive and waits only for acknowledgements, never for a move.
/// Every function throws Error(device) naming host:port, unit, register and axis when the drive does not do what was asked.
class Drive {
 public:
  struct State {
    std::uint16_t status = 0;
    std::uint32_t error = 0;
    std::int64_t position = 0;
  };

  Drive(const Axis& axis, Bus& bus, Clock& clock);

  const Axis& axis() const { return axis_; }

  /// Probes the profile by its speed registers (a wrong image shows here, before the first move), resets a fault that may be reset,
  /// and enables the drive.
  void enable();
  /// Status, error and position in one request where the image allows it.
  State state();
  /// Error(device) with the alarm's code and text if the fault bit stands.
  void require_no_fault(const State& state) const;
  /// Status bit and distance; settling is the caller's.
  bool is_in_position(const State& state, std::int64_t target) const;
  void set_target(std::int64_t counts);
  void start();
  /// The writes of the stop command, without waiting: other axes have to be told first.
  void stop();

 private:
  void run(const std::vector<CommandStep>& steps, bool wait = true);
  void write(const RegisterField& field, double quantity);
  std::string where(int address) const;
  std::int64_t read(const RegisterField& field);

  Axis axis_;
  Bus& bus_;
  Clock& clock_;
};

}  // namespace gonio::acquisition::modbus
