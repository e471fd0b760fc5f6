// SPDX-License-Identifier: BSD-3-Clause
// The simulated bench: drives, shutter and meter behind the same wire protocols as real ones.
#pragma once

#include <memory>

#include "acquisition/bench.hpp"
#include "acquisition/clock.hpp"
#include "brdf/brdf.hpp"

namespace gonio::acquisition::simulated {

/// Emulated devices on loopback: one Modbus TCP server (a unit per axis, the I/O unit, and unit 247 for a virtual clock that is
/// shared across processes) and one SCPI socket. Each device is a pure function of its last commands and the clock.
class SimulatedBench {
 public:
  struct Ports {
    int modbus = 0, scpi = 0;
  };
  /// Binds at once (port 0: any free one; Error(device) naming the port if it is in use) and serves from its own threads.
  SimulatedBench(const Bench& bench, std::shared_ptr<const Brdf> sample, std::shared_ptr<Clock> clock);
  ~SimulatedBench();
  Ports ports() const;
  void stop() noexcept;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace gonio::acquisition::simulated
