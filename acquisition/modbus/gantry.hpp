// SPDX-License-Identifier: BSD-3-Clause
// The axes of a bench as drives on one Modbus bus.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "acquisition/devices.hpp"
#include "acquisition/modbus/drive.hpp"

namespace gonio::acquisition::modbus {

/// In position means: status bit, and read-back within the axis' tolerance, and both still so after the settling time.
/// Bench time is used for motion and settling; it sleeps to the predicted arrival and then polls.
class ModbusGantry final : public Gantry {
 public:
  /// Probes and enables every drive; nothing moves. `stop`: ends a move in progress with Error(interrupted).
  ModbusGantry(const Bench& bench, std::shared_ptr<Bus> bus, std::shared_ptr<Clock> clock, const std::atomic<bool>* stop = nullptr);

  AxisState move_to(const AxisAngles& target) override;
  AxisState read_back() override;
  bool stop() noexcept override;

 private:
  std::vector<Drive::State> states();
  AxisState result(const std::vector<Drive::State>& states) const;
  std::vector<std::int64_t> require_within_limits(const AxisAngles& target) const;
  std::vector<Drive::State> wait_in_position(const std::vector<std::int64_t>& target, BenchTime deadline, bool is_settled);
  void sleep_until(BenchTime wake);

  std::shared_ptr<Bus> bus_;
  std::shared_ptr<Clock> clock_;
  std::vector<Drive> drives_;
  std::vector<std::optional<std::int64_t>> commanded_;
  std::vector<Drive::State> last_;  // read back since the last move ended, or empty
  BenchTime settle_ = 0;
  const std::atomic<bool>* stop_;
};

}  // namespace gonio::acquisition::modbus
