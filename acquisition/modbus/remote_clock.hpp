// SPDX-License-Identifier: BSD-3-Clause
// The virtual clock of a simulated bench in another process.
#pragma once

#include <memory>

#include "acquisition/clock.hpp"
#include "acquisition/modbus/bus.hpp"

namespace gonio::acquisition::modbus {

/// Reads and advances the server's clock over its clock unit (247). One member: whoever owns the bus.
class RemoteClock final : public Clock {
 public:
  explicit RemoteClock(std::shared_ptr<Bus> bus);

  /// True if the server behind the bus owns a virtual clock; Error(device) if it has no clock unit.
  static bool is_offered(Bus& bus);

  BenchTime now() const override;
  void sleep_until(BenchTime wake, int member = 0) override;
  bool is_virtual() const override { return true; }

 private:
  std::shared_ptr<Bus> bus_;
};

}  // namespace gonio::acquisition::modbus
