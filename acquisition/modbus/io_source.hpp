// SPDX-License-Identifier: BSD-3-Clause
// Shutter, sample slide and lamp of a bench behind one Modbus unit.
#pragma once

#include <memory>

#include "acquisition/devices.hpp"
#include "acquisition/modbus/bus.hpp"

namespace gonio::acquisition::modbus {

/// Every output is read back. Tags of readings are announced only to a simulated bench, in its clock unit.
class IoSource final : public Source {
 public:
  /// Error(device) if the unit does not answer or the lamp is out.
  IoSource(const Bench& bench, std::shared_ptr<Bus> bus);

  void open_shutter(bool open) override;
  void present(StepKind kind) override;
  void announce(const ReadingTag& tag) override;
  bool make_safe() noexcept override;

 private:
  void set(int address, std::uint16_t value);

  std::shared_ptr<Bus> bus_;
  int unit_;
  bool is_simulated_;
};

}  // namespace gonio::acquisition::modbus
