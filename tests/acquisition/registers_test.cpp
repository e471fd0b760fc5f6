// SPDX-License-Identifier: BSD-3-Clause
// Packing of numbers into registers.
#include "acquisition/modbus/registers.hpp"

#include <cstdint>
#include <limits>

#include "brdf/error.hpp"
#include "tests/check.hpp"

using namespace gonio::acquisition;
using namespace gonio::acquisition::modbus;
using Type = RegisterField::Type;

TEST_CASE("Times and tags come back from their registers") {
  for (const BenchTime t : {BenchTime{0}, BenchTime{1}, 36000 * second, std::numeric_limits<BenchTime>::max()})
    CHECK(unpack_time(pack_time(t)) == t);
  CHECK(pack_time(0x0001000200030004) == std::array<std::uint16_t, 4>{1, 2, 3, 4});
  const ReadingTag tag{70'000'123'456, StepKind::reference, 3, 41};
  const ReadingTag back = unpack_tag(pack_tag(tag));
  CHECK(back.step == tag.step);
  CHECK(back.kind == tag.kind);
  CHECK(back.attempt == tag.attempt);
  CHECK(back.repeat == tag.repeat);
}

TEST_CASE("Fields keep sign, width and word order") {
  CHECK(pack(Type::i32, 70000, true) == std::vector<std::uint16_t>{1, 4464});
  CHECK(pack(Type::i32, 70000, false) == std::vector<std::uint16_t>{4464, 1});
  CHECK(pack(Type::i32, -5, true) == std::vector<std::uint16_t>{0xffff, 0xfffb});
  for (const bool high_first : {true, false}) {
    for (const std::int64_t v : {-180'000'000L, -1L, 0L, 65536L, 2'147'483'647L})
      CHECK(unpack(Type::i32, pack(Type::i32, v, high_first), high_first) == v);
    CHECK(unpack(Type::u32, pack(Type::u32, 4'000'000'000, high_first), high_first) == 4'000'000'000);
  }
  CHECK(unpack(Type::i16, pack(Type::i16, -7, true), true) == -7);
  CHECK(unpack(Type::u16, pack(Type::u16, 65535, true), true) == 65535);
}

TEST_CASE("A value that does not fit its register is refused, never cut") {
  CHECK_THROWS_AS(pack(Type::u16, 65536, true), gonio::Error);
  CHECK_THROWS_AS(pack(Type::u16, -1, true), gonio::Error);
  CHECK_THROWS_AS(pack(Type::i32, 2'147'483'648, true), gonio::Error);
}
