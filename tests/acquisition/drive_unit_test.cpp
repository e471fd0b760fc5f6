// SPDX-License-Identifier: BSD-3-Clause
// The emulated CiA 402 drive, driven by its registers.
#include "acquisition/simulated/drive_unit.hpp"

#include "acquisition/modbus/registers.hpp"
#include "acquisition/trapezoidal_motion.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio::acquisition;
using namespace gonio::acquisition::test;
using simulated::DriveUnit;

namespace {

struct Drive {
  Axis axis = ideal_bench().axes.front();
  DriveUnit unit{axis, true};
  BenchTime now = 0;

  void write(int address, std::int64_t value, RegisterField::Type type = RegisterField::Type::u16) {
    const auto words = modbus::pack(type, value, true);
    for (std::size_t k = 0; k < words.size(); ++k) unit.registers()[static_cast<std::size_t>(address - unit.first()) + k] = words[k];
    unit.written(address, static_cast<int>(words.size()), now);
  }
  int status() {
    unit.refresh(now);
    return unit.registers()[static_cast<std::size_t>(5000 - unit.first())];
  }
  void enable() {
    write(6001, 1);
    write(6004, 60'000'000, RegisterField::Type::u32);
    for (const int word : {0x06, 0x07, 0x0f}) write(6000, word);
  }
  void start(std::int64_t target) {
    write(6002, target, RegisterField::Type::i32);
    write(6000, 0x3f);
  }
};

}  // namespace

TEST_CASE("The state machine goes its way and no other") {
  Drive d;
  CHECK((d.status() & 0x6f) == 0x40);
  d.write(6000, 0x0f);  // not from here
  CHECK((d.status() & 0x6f) == 0x40);
  d.write(6000, 0x06);
  CHECK((d.status() & 0x6f) == 0x21);
  d.write(6000, 0x07);
  CHECK((d.status() & 0x6f) == 0x23);
  d.write(6000, 0x0f);
  CHECK((d.status() & 0x6f) == 0x27);
  d.write(6000, 0x02);
  CHECK((d.status() & 0x6f) == 0x07);
  d.write(6000, 0x00);
  CHECK((d.status() & 0x6f) == 0x40);
}

TEST_CASE("A set-point needs a rising edge in an enabled drive, and is acknowledged until the bit falls") {
  Drive d;
  d.start(1'000'000);
  d.now = 100 * second;
  CHECK(d.unit.position(d.now) == 0);  // not enabled
  d.enable();
  d.start(30'000'000);
  CHECK((d.status() & 0x1000) != 0);
  CHECK((d.status() & 0x0400) == 0);
  d.write(6002, 1, RegisterField::Type::i32);
  d.write(6000, 0x3f);  // no edge: the first target stays
  d.write(6000, 0x2f);
  CHECK((d.status() & 0x1000) == 0);
  const double duration = move_duration_s(30, 60, 120);
  CHECK(d.unit.position(d.now + bench_time(duration / 2)) == 15'000'000);
  d.now += bench_time(duration);
  CHECK(d.unit.position(d.now) == 30'000'000);
  CHECK((d.status() & 0x0400) != 0);
}

TEST_CASE("Halt brakes with the axis' deceleration, and the drive can go on from there") {
  Drive d;
  d.enable();
  d.start(90'000'000);
  d.now += second;  // at full speed, 60 °/s
  const std::int64_t at_halt = d.unit.position(d.now);
  d.write(6000, 0x010f);
  CHECK((d.status() & 0x0400) == 0);
  CHECK(d.unit.position(d.now) == at_halt);
  d.now += bench_time(60.0 / 120);
  CHECK(d.unit.position(d.now) == at_halt + 15'000'000);  // v²/2a = 15°
  CHECK(d.unit.position(d.now + second) == d.unit.position(d.now));
  CHECK((d.status() & 0x0400) != 0);
  d.start(0);
  d.now += 100 * second;
  CHECK(d.unit.position(d.now) == 0);
}

TEST_CASE("Without motion a move takes no time") {
  Drive d;
  d.unit = DriveUnit(d.axis, false);
  d.enable();
  d.start(-179'999'999);
  CHECK(d.unit.position(d.now) == -179'999'999);
  CHECK((d.status() & 0x0400) != 0);
}
