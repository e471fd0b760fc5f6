// SPDX-License-Identifier: BSD-3-Clause
// Packing of times, tags and register fields.
#include "acquisition/modbus/registers.hpp"

#include <fmt/format.h>

#include <limits>

#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {
namespace {

std::uint16_t word(std::uint64_t value, int index) noexcept { return static_cast<std::uint16_t>(value >> (16 * index)); }

struct Range {
  std::int64_t lower, upper;
};

Range range(RegisterField::Type type) noexcept {
  switch (type) {
    case RegisterField::Type::u16: return {0, std::numeric_limits<std::uint16_t>::max()};
    case RegisterField::Type::i16: return {std::numeric_limits<std::int16_t>::min(), std::numeric_limits<std::int16_t>::max()};
    case RegisterField::Type::u32: return {0, std::numeric_limits<std::uint32_t>::max()};
    case RegisterField::Type::i32: break;
  }
  return {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
}

}  // namespace

std::array<std::uint16_t, clock_unit::time_count> pack_time(BenchTime time) noexcept {
  const auto t = static_cast<std::uint64_t>(time);
  return {word(t, 3), word(t, 2), word(t, 1), word(t, 0)};
}

BenchTime unpack_time(std::span<const std::uint16_t, clock_unit::time_count> r) noexcept {
  return static_cast<BenchTime>(std::uint64_t{r[0]} << 48 | std::uint64_t{r[1]} << 32 | std::uint64_t{r[2]} << 16 | r[3]);
}

std::array<std::uint16_t, clock_unit::tag_count> pack_tag(const ReadingTag& tag) noexcept {
  const auto step = static_cast<std::uint64_t>(tag.step);
  return {word(step, 2),
          word(step, 1),
          word(step, 0),
          static_cast<std::uint16_t>(tag.kind),
          static_cast<std::uint16_t>(tag.attempt),
          static_cast<std::uint16_t>(tag.repeat)};
}

ReadingTag unpack_tag(std::span<const std::uint16_t, clock_unit::tag_count> r) noexcept {
  return {static_cast<std::int64_t>(std::uint64_t{r[0]} << 32 | std::uint64_t{r[1]} << 16 | r[2]), static_cast<StepKind>(r[3]), r[4], r[5]};
}

std::vector<std::uint16_t> pack(RegisterField::Type type, std::int64_t value, bool high_word_first) {
  const auto [lower, upper] = range(type);
  if (value < lower || value > upper) {
    throw Error(ErrorKind::internal,
                Fault{"register value", std::to_string(value), fmt::format("a value from {} to {}, the range of its type", lower, upper)});
  }
  const auto bits = static_cast<std::uint64_t>(value);
  if (RegisterField{.type = type}.registers() == 1) return {word(bits, 0)};
  if (high_word_first) return {word(bits, 1), word(bits, 0)};
  return {word(bits, 0), word(bits, 1)};
}

std::int64_t unpack(RegisterField::Type type, std::span<const std::uint16_t> r, bool high_word_first) noexcept {
  if (type == RegisterField::Type::u16) return r[0];
  if (type == RegisterField::Type::i16) return static_cast<std::int16_t>(r[0]);
  const std::uint32_t bits = high_word_first ? std::uint32_t{r[0]} << 16 | r[1] : std::uint32_t{r[1]} << 16 | r[0];
  if (type == RegisterField::Type::u32) return bits;
  return static_cast<std::int32_t>(bits);
}

}  // namespace gonio::acquisition::modbus
