// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_header.hpp"

#include <cstring>

#include "tabulated/formats/exr_image.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::string attribute(const std::string& name, std::int32_t size, const std::string& value, const std::string& type = "string") {
  std::string out = name + '\0' + type + '\0';
  out.append(reinterpret_cast<const char*>(&size), sizeof size);
  return out + value;
}

const std::string one_part("\x76\x2f\x31\x01\x02\0\0\0", 8), several_parts("\x76\x2f\x31\x01\x02\x10\0\0", 8), end(1, '\0');

}  // namespace

TEST_CASE("An attribute that claims more than the file holds is refused where it starts, in any part") {
  const test::TemporaryFolder scratch;
  const auto faults = [&](const std::string& bytes) {
    return test::faults_of([&] { require_sound_exr_header(scratch.file("x.exr", bytes)); });
  };
  const std::string sound = attribute("a", 3, "abc"), greedy = attribute("big", 1668481024, "abc");
  CHECK(faults(one_part + sound + end).empty());
  CHECK(faults(one_part + greedy + end).find("byte 8|an attribute 'big' of 1668481024 bytes, 4 bytes before the end") != std::string::npos);
  CHECK(faults(one_part + sound + attribute("less", -1, "") + end).find("byte 24|") != std::string::npos);
  CHECK(faults(several_parts + sound + end + greedy + end + end).find("'big'") != std::string::npos);
  CHECK(faults(several_parts + sound + end + sound + end + end).empty());
  CHECK(faults(one_part + sound + end + greedy).empty());  // those are pixels
}

TEST_CASE("A value of another size than its type has is refused, and so are types that hold sizes of their own") {
  const test::TemporaryFolder scratch;
  const auto faults = [&](std::int32_t size, const std::string& value, const std::string& type) {
    return test::faults_of([&] { require_sound_exr_header(scratch.file("x.exr", one_part + attribute("a", size, value, type) + end)); });
  };
  const std::string channel = std::string("R\0", 2) + std::string(16, '\0');
  CHECK(faults(4, "1234", "int").empty());
  CHECK(faults(5, "12345", "int").find("an attribute 'a' of type 'int' and 5 bytes") != std::string::npos);
  CHECK(faults(19, channel + end, "chlist").empty());
  CHECK_FALSE(faults(20, channel + end + end, "chlist").empty());
  CHECK_FALSE(faults(18, channel, "chlist").empty());
  CHECK_FALSE(faults(10, channel.substr(0, 10), "chlist").empty());
  CHECK_FALSE(faults(4, "1234", "preview").empty());
  CHECK(faults(4, "1234", "whatever").empty());
}

TEST_CASE("A part of more pixels than the file could hold is refused, by its window or by its tiles") {
  const test::TemporaryFolder scratch;
  const auto words = [](std::initializer_list<std::int32_t> numbers) {
    std::string out;
    for (const std::int32_t number : numbers) out.append(reinterpret_cast<const char*>(&number), sizeof number);
    return out;
  };
  const auto faults = [&](const std::string& window, const std::string& tiles) {
    const std::string channel = std::string("R\0", 2) + std::string(16, '\0');
    const std::string bytes = one_part + attribute("channels", 19, channel + end, "chlist") + attribute("dataWindow", 16, window, "box2i") +
                              attribute("tiles", 9, tiles, "tiledesc") + end;
    return test::faults_of([&] { require_sound_exr_header(scratch.file("x.exr", bytes)); });
  };
  const std::string small = words({0, 0, 63, 63}), tiles = words({64, 64}) + end;
  CHECK(faults(small, tiles).empty());
  CHECK(faults(words({0, 0, 20000000, 3586}), tiles).find("cannot hold more") != std::string::npos);
  CHECK(faults(words({-2147483647, -2147483647, 2147483647, 2147483647}), tiles).find("cannot hold more") != std::string::npos);
  CHECK(faults(small, words({-1, 65536}) + end).find("cannot hold more") != std::string::npos);
}

TEST_CASE("A picture of ours is sound; what ends too early is left to the library") {
  const test::TemporaryFolder scratch;
  write_exr_image({2, 1, {{"Y", {1, 2}}}, {{"a", "text"}}}, scratch / "image.exr");
  CHECK_NOTHROW(require_sound_exr_header(scratch / "image.exr"));
  for (const std::string& bytes : {std::string("v"), one_part, one_part + "name", one_part + attribute("a", 3, "abc")})
    CHECK_NOTHROW(require_sound_exr_header(scratch.file("short", bytes)));
}
