// SPDX-License-Identifier: BSD-3-Clause
// Bench time over Modbus registers.
#include "acquisition/modbus/remote_clock.hpp"

#include <array>

#include "acquisition/modbus/registers.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {

RemoteClock::RemoteClock(std::shared_ptr<Bus> bus) : bus_(std::move(bus)) {}

bool RemoteClock::is_offered(Bus& bus) { return bus.read(clock_unit::unit, clock_unit::is_virtual) == 1; }

BenchTime RemoteClock::now() const {
  std::array<std::uint16_t, clock_unit::time_count> registers{};
  bus_->read(clock_unit::unit, clock_unit::time, registers);
  return unpack_time(registers);
}

void RemoteClock::sleep_until(BenchTime wake, int) {
  // Not `write`: the read-back may be later than what was written, because an earlier time never sets the clock back.
  bus_->write_unverified(clock_unit::unit, clock_unit::time, pack_time(wake));
  if (const BenchTime reached = now(); reached < wake) {
    throw Error(ErrorKind::device, Fault{bus_->where(clock_unit::unit, clock_unit::time), std::to_string(reached) + " ns",
                                         "at least " + std::to_string(wake) + " ns, as written"});
  }
}

}  // namespace gonio::acquisition::modbus
