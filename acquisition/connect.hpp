// SPDX-License-Identifier: BSD-3-Clause
// From a bench file to its devices, ready to sweep.
#pragma once

#include <atomic>
#include <memory>

#include "acquisition/bench.hpp"
#include "acquisition/clock.hpp"
#include "acquisition/devices.hpp"

namespace gonio::acquisition {

/// The devices of one bench and the clock they live on. The gantry, the source and a remote clock share one Modbus connection:
/// one owner per bus, so use them from one thread.
struct ConnectedBench {
  std::shared_ptr<Clock> clock;
  std::unique_ptr<Gantry> gantry;
  std::unique_ptr<Detector> detector;
  std::unique_ptr<Source> source;
};

/// Connects to the drives and the I/O unit over Modbus TCP and to the power meter over SCPI, checks identities, probes every drive's
/// profile and enables the drives; nothing moves yet.
/// `clock`: the clock to live on (an embedded simulated bench shares its own); none: the bench's own virtual clock if it is a simulated
/// one that owns such a clock, the real clock otherwise.
/// `stop`: when it becomes true a move in progress ends with Error(interrupted).
/// Error(device) naming host:port, unit, register, found and wanted if anything does not answer or is not what the file says.
ConnectedBench connect(const Bench& bench, std::shared_ptr<Clock> clock = nullptr, const std::atomic<bool>* stop = nullptr);

}  // namespace gonio::acquisition
