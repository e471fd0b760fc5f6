// SPDX-License-Identifier: BSD-3-Clause
// Writes of the I/O unit's registers, each only when it changes something.
#include "acquisition/modbus/io_source.hpp"

#include <array>

#include "acquisition/modbus/registers.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {

IoSource::IoSource(const Bench& bench, std::shared_ptr<Bus> bus)
    : bus_(std::move(bus)), unit_(bench.io_unit), is_simulated_(bench.is_simulated) {
  set(io_unit::shutter, 0);
}

void IoSource::set(int address, std::uint16_t value) {
  std::array<std::uint16_t, io_unit::count> state{};
  bus_->read(unit_, 0, state);
  if (state[io_unit::lamp] != 1) {
    throw Error(ErrorKind::device, Fault{bus_->where(unit_, io_unit::lamp) + " (lamp)", std::to_string(state[io_unit::lamp]), "1, lit"});
  }
  if (state[static_cast<std::size_t>(address)] != value) bus_->write(unit_, address, {&value, 1});
}

void IoSource::open_shutter(bool open) { set(io_unit::shutter, open ? 1 : 0); }

void IoSource::present(StepKind kind) {
  if (kind != StepKind::dark) set(io_unit::slide, kind == StepKind::reference ? 1 : 0);
}

void IoSource::announce(const ReadingTag& tag) {
  if (is_simulated_) bus_->write(clock_unit::unit, clock_unit::tag, pack_tag(tag));
}

bool IoSource::make_safe() noexcept {
  try {
    const std::uint16_t closed = 0;
    bus_->write(unit_, io_unit::shutter, {&closed, 1});
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace gonio::acquisition::modbus
