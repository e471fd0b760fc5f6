// SPDX-License-Identifier: BSD-3-Clause
// Register images that gonio itself defines (I/O unit, clock unit) and the packing of numbers into registers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/axis_profile.hpp"
#include "acquisition/clock.hpp"
#include "acquisition/devices.hpp"

namespace gonio::acquisition::modbus {

/// The I/O unit: outputs of shutter and slide, input of the lamp.
namespace io_unit {
constexpr int shutter = 0;  ///< 1 open, 0 closed
constexpr int slide = 1;    ///< 0 sample under the beam, 1 white reference
constexpr int lamp = 2;     ///< read only: 1 lit
constexpr int count = 3;
}  // namespace io_unit

/// The unit of a simulated bench that is no device: bench time and the tag of the coming reading.
namespace clock_unit {
constexpr int unit = 247;
constexpr int time = 0;  ///< u64 nanoseconds, high word first; writing advances a virtual clock, an earlier time is ignored
constexpr int time_count = 4;
constexpr int is_virtual = 4;  ///< 1: the server owns a virtual clock; 0: a real one, whose time cannot be written
constexpr int tag = 8;         ///< step (u48, high word first), kind, attempt, repeat
constexpr int tag_count = 6;
constexpr int count = tag + tag_count;
}  // namespace clock_unit

std::array<std::uint16_t, clock_unit::time_count> pack_time(BenchTime time) noexcept;
BenchTime unpack_time(std::span<const std::uint16_t, clock_unit::time_count> registers) noexcept;
std::array<std::uint16_t, clock_unit::tag_count> pack_tag(const ReadingTag& tag) noexcept;
ReadingTag unpack_tag(std::span<const std::uint16_t, clock_unit::tag_count> registers) noexcept;

/// The field's registers for a value; 32-bit values in the profile's word order. Error(internal) if the value does not fit the type.
std::vector<std::uint16_t> pack(RegisterField::Type type, std::int64_t value, bool high_word_first);
std::int64_t unpack(RegisterField::Type type, std::span<const std::uint16_t> registers, bool high_word_first) noexcept;

}  // namespace gonio::acquisition::modbus
