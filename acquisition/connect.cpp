// SPDX-License-Identifier: BSD-3-Clause
// Makes the drivers that a bench file asks for.
#include "acquisition/connect.hpp"

#include "acquisition/modbus/bus.hpp"
#include "acquisition/modbus/gantry.hpp"
#include "acquisition/modbus/io_source.hpp"
#include "acquisition/modbus/remote_clock.hpp"
#include "acquisition/scpi_power_meter.hpp"

namespace gonio::acquisition {

ConnectedBench connect(const Bench& bench, std::shared_ptr<Clock> clock, const std::atomic<bool>* stop) {
  const auto bus = std::make_shared<modbus::Bus>(bench.modbus);
  if (!clock) {
    if (bench.is_simulated && modbus::RemoteClock::is_offered(*bus)) {
      clock = std::make_shared<modbus::RemoteClock>(bus);
    } else {
      clock = std::make_shared<RealClock>();
    }
  }
  // The shutter is closed before any drive is enabled.
  auto source = std::make_unique<modbus::IoSource>(bench, bus);
  auto detector = std::make_unique<ScpiPowerMeter>(bench.scpi, bench.expected_idn);
  auto gantry = std::make_unique<modbus::ModbusGantry>(bench, bus, clock, stop);
  return {std::move(clock), std::move(gantry), std::move(detector), std::move(source)};
}

}  // namespace gonio::acquisition
