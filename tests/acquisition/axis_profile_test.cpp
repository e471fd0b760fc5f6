// SPDX-License-Identifier: BSD-3-Clause
// The built-in profile, and profiles that contradict themselves.
#include "acquisition/axis_profile.hpp"

#include <algorithm>
#include <functional>
#include <sstream>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;

namespace {

std::vector<int> bytes_of(const std::string& frame) {
  std::istringstream in(frame);
  in >> std::hex;
  std::vector<int> bytes;
  for (int byte = 0; in >> byte;) bytes.push_back(byte);
  return bytes;
}

int word(const std::vector<int>& bytes, std::size_t at) { return bytes.at(at) << 8 | bytes.at(at + 1); }

Json cia402() { return parse_json(axis_profile_text("cia402"), "cia402"); }

/// A copy with the member at `path` replaced.
Json with(const Json& document, const std::vector<std::string>& path, Json value) {
  Json out = document;
  if (path.size() == 1) return out.set(path[0], std::move(value));
  out.set(path[0], with(document.at(path[0]), {path.begin() + 1, path.end()}, std::move(value)));
  return out;
}

std::vector<std::string> faults(const Json& document) {
  try {
    axis_profile_from(document, "p");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    std::vector<std::string> places;
    for (const Fault& fault : error.faults()) places.push_back(fault.where);
    return places;
  }
  return {};
}

using Places = std::vector<std::string>;

}  // namespace

TEST_CASE("cia402 is the default image of CiA 402 drives") {
  const AxisProfile p = load_axis_profile("cia402", ".");
  CHECK(p.error.address == 4997);
  CHECK(p.status.address == 5000);
  CHECK(p.position.address == 5002);
  CHECK(p.control.address == 6000);
  CHECK(p.mode.address == 6001);
  CHECK(p.target.address == 6002);
  CHECK(p.velocity.address == 6004);
  CHECK(p.high_word_first);
  CHECK(p.fault.bit == 3);
  CHECK(p.target_reached.bit == 10);
  CHECK(p.set_point_acknowledged.bit == 12);
  REQUIRE(p.enable.size() == 4);
  CHECK(p.enable[1].value == 0x06);
  CHECK(p.enable[2].value == 0x07);
  CHECK(p.enable[3].value == 0x0F);
  CHECK(p.start.front().value == 0x3F);
  CHECK(p.written_field("target") == &p.target);
  CHECK(p.written_field("acceleration") == nullptr);
  CHECK(p.alarm_text(0x8611) == "alarm 0x8611: position following error");
  CHECK(p.alarm_text(0x1234) == "alarm 0x1234: not in the profile's list");
}

TEST_CASE("the new set point is a rising edge of bit 4, absolute, and the edge is taken back") {
  const AxisProfile p = load_axis_profile("cia402", ".");
  REQUIRE(p.start.size() == 2);
  CHECK((p.start[0].value & 0x10) != 0);
  CHECK((p.start[0].value & 0x40) == 0);
  CHECK((p.start[1].value & 0x10) == 0);
  CHECK(p.set_point_acknowledged.in(0x1000));
  CHECK_FALSE(p.set_point_acknowledged.in(0x0000));
}

TEST_CASE("the golden frames of cia402 read and write the registers the profile names") {
  const AxisProfile p = load_axis_profile("cia402", ".");
  REQUIRE(p.golden_frames.size() == 3);
  REQUIRE(p.poll.has_value());
  const auto poll = bytes_of(p.golden_frames[0].request), answer = bytes_of(p.golden_frames[0].response);
  CHECK(poll[0] == p.poll->function_code);
  CHECK(word(poll, 1) == p.poll->address);
  CHECK(word(poll, 3) == p.poll->count);
  REQUIRE(answer.size() == static_cast<std::size_t>(2 + 2 * p.poll->count));
  const auto at = [&](const RegisterField& f) { return static_cast<std::size_t>(2 + 2 * (f.address - p.poll->address)); };
  CHECK(p.enabled.in(static_cast<std::uint16_t>(word(answer, at(p.status)))));
  CHECK(p.target_reached.in(static_cast<std::uint16_t>(word(answer, at(p.status)))));
  CHECK((word(answer, at(p.position)) << 16 | word(answer, at(p.position) + 2)) == 30000000);
  const auto target = bytes_of(p.golden_frames[1].request);
  CHECK(target[0] == p.target.function_code);
  CHECK(word(target, 1) == p.target.address);
  CHECK(word(target, 3) == p.target.registers());
  CHECK((word(target, 6) << 16 | word(target, 8)) == 30000000);
  const auto control = bytes_of(p.golden_frames[2].request);
  CHECK(word(control, 1) == p.control.address);
  CHECK(static_cast<std::uint32_t>(word(control, 6)) == p.start[0].value);
}

TEST_CASE("a profile that contradicts itself is refused where it does") {
  const Json good = cia402();
  CHECK(faults(good).empty());
  CHECK(faults(with(good, {"write", "target", "fc"}, 6)) == Places{"p#/write/target/fc"});
  CHECK(faults(with(good, {"write", "target", "type"}, "u32")) == Places{"p#/write/target/type"});
  CHECK(faults(with(good, {"write", "target", "scale"}, 2.0)) == Places{"p#/write/target/scale"});
  CHECK(faults(with(good, {"write", "mode", "address"}, 6000)) == Places{"p#/write/mode/address"});
  CHECK(faults(with(good, {"write", "velocity", "address"}, 65535)) == Places{"p#/write/velocity/address"});
  CHECK(faults(with(good, {"poll", "count"}, 6)) == Places{"p#/poll"});
  CHECK(faults(with(good, {"poll", "fc"}, 4)).size() == 3);
  const Json wait = parse_json(R"([{"wait": {"mask": "0x04", "value": "0x06", "timeout_s": 1}}])", "t");
  CHECK(faults(with(good, {"commands", "stop"}, wait)) == Places{"p#/commands/stop/0/wait/value"});
  const Json no_field = parse_json(R"([{"write": {"field": "acceleration", "value": "0x06"}}])", "t");
  CHECK(faults(with(good, {"commands", "stop"}, no_field)) == Places{"p#/commands/stop/0/write/field"});
  const Json too_wide = parse_json(R"([{"write": {"field": "control", "value": "0x10000"}}])", "t");
  CHECK(faults(with(good, {"homing"}, too_wide)) == Places{"p#/homing/0/write/value"});
  const Json twice =
      parse_json(R"([{"code": "0x10", "text": "a", "resettable": true}, {"code": "0x0010", "text": "b", "resettable": true}])", "t");
  CHECK(faults(with(good, {"alarms"}, twice)) == Places{"p#/alarms/1/code"});
}

TEST_CASE("faults against the schema are named all at once") {
  Json document = with(cia402(), {"word_order"}, "middle-first");
  document = with(document, {"read", "status", "fc"}, 16);
  document = with(document, {"status_bits", "fault", "bit"}, 16);
  Places places = faults(document);
  std::sort(places.begin(), places.end());
  CHECK(places == Places{"p#/read/status/fc", "p#/status_bits/fault/bit", "p#/word_order"});
}

TEST_CASE("a profile that is not there is refused by its name") {
  CHECK_THROWS_AS(load_axis_profile("no-such-profile", "/nowhere"), Error);
}

TEST_CASE("a profile with watchdog, homing, acceleration and scales is read from a file") {
  const AxisProfile p =
      load_axis_profile("servo.axis-profile.json", std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid");
  REQUIRE(p.watchdog.has_value());
  CHECK(p.watchdog->function_code == 6);
  REQUIRE(p.acceleration.has_value());
  CHECK(p.acceleration->scale == 10);
  CHECK(p.homing.size() == 4);
  CHECK(p.homed.has_value());
  CHECK_FALSE(p.poll.has_value());
}
