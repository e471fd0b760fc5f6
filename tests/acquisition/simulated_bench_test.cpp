// SPDX-License-Identifier: BSD-3-Clause
// The servers of the simulated bench against clients that send anything.
#include "acquisition/simulated/simulated_bench.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <random>

#include "acquisition/modbus/bus.hpp"
#include "acquisition/modbus/registers.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

/// Sends bytes on a connection of their own and waits until the server has hung up or answered everything.
void send_and_drain(int port, const std::string& bytes) {
  const int s = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(s, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  (void)!send(s, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  shutdown(s, SHUT_WR);
  std::array<char, 4096> answer{};
  while (recv(s, answer.data(), answer.size(), 0) > 0) {
  }
  close(s);
}

}  // namespace

TEST_CASE("Mutated Modbus frames neither break the server nor move an axis that is not enabled") {
  EmbeddedBench b(ideal_bench());
  using namespace std::string_literals;
  const std::string frames[] = {"\x00\x01\x00\x00\x00\x06\x01\x03\x13\x85\x00\x07"s,                      // poll
                                "\x00\x02\x00\x00\x00\x0b\x02\x10\x17\x72\x00\x02\x04\x00\x01\x11\x70"s,  // target
                                "\x00\x03\x00\x00\x00\x06\x0a\x06\x00\x00\x00\x01"s,                      // shutter
                                "\x00\x04\x00\x00\x00\x06\xf7\x03\x00\x00\x00\x0e"s};                     // clock
  constexpr unsigned seed = 17;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 1000; ++k) {
    std::string bytes = frames[random() % std::size(frames)];
    // The clock's time stays as it is: a mutated frame may advance it to the end of time.
    for (int n = 0; n < k % 5; ++n) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (k % 7 == 0) bytes.resize(random() % bytes.size());
    if (k % 11 == 0) bytes += frames[random() % std::size(frames)];
    send_and_drain(b.bench.modbus.port, bytes);
  }
  modbus::Bus bus(b.bench.modbus);
  for (const Axis& axis : b.bench.axes) {
    std::array<std::uint16_t, 2> position{};
    bus.read(axis.unit, 5002, position);
    CHECK(modbus::unpack(RegisterField::Type::i32, position, true) == 0);
  }
}

TEST_CASE("Any bytes on the meter's port leave it able to answer") {
  EmbeddedBench b(ideal_bench());
  std::mt19937 random(23);
  for (int k = 0; k < 300; ++k) {
    std::string bytes(random() % 200, '\0');
    for (char& c : bytes) c = static_cast<char>(k % 2 ? random() : 32 + random() % 64);
    send_and_drain(b.bench.scpi.port, bytes + (k % 3 ? "\n" : ""));
  }
  send_and_drain(b.bench.scpi.port, std::string(200'000, 'x'));  // a line without an end
  ConnectedBench devices = gonio::acquisition::connect(b.bench, b.clock);
  CHECK(devices.detector->identity().starts_with(b.bench.expected_idn));
}

TEST_CASE("Several clients are served at once, and stopping twice is harmless") {
  EmbeddedBench b(ideal_bench());
  modbus::Bus first(b.bench.modbus), second_one(b.bench.modbus);
  const std::uint16_t one = 1;
  first.write(b.bench.io_unit, modbus::io_unit::shutter, {&one, 1});
  CHECK(second_one.read(b.bench.io_unit, modbus::io_unit::shutter) == 1);
  b.simulated.stop();
  b.simulated.stop();
  CHECK_THROWS_AS(first.read(b.bench.io_unit, 0), gonio::Error);
}
