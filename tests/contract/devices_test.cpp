// SPDX-License-Identifier: BSD-3-Clause
// The device contract on the drivers against emulated devices in this and in another process, and what happens when a device misbehaves.
#include <atomic>
#include <utility>

#include "acquisition/modbus/bus.hpp"
#include "acquisition/modbus/registers.hpp"
#include "tests/acquisition/bench_process.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/contract/device_contract.hpp"
#include "tests/contract/modbus_proxy.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

constexpr int control_register = 6000, target_register = 6002, poll_register = 4997;  // the cia402 image
constexpr int error_index = 0, status_index = 3, position_index = 5;                  // in the answer to a poll

Bench moving_bench() {
  Bench bench = ideal_bench();
  bench.simulated.motion = true;
  return bench;
}

/// A moving bench whose Modbus traffic goes through a proxy.
struct ProxiedBench {
  EmbeddedBench embedded{moving_bench()};
  ModbusProxy proxy{embedded.bench.modbus.port};
  Bench bench = [this] {
    Bench b = embedded.bench;
    b.modbus.port = proxy.port();
    return b;
  }();
  ConnectedBench devices = connect(bench, embedded.clock);

  /// Error text of a move under the behaviour; it has to be a device error.
  std::string failure_of_a_move(ModbusProxy::Behaviour behaviour) {
    proxy.behave(std::move(behaviour));
    std::string text;
    CHECK(error_kind([&] { devices.gantry->move_to({20, -20, 30, 40}); }, &text) == ErrorKind::device);
    return text;
  }
  /// After a fault: the stop is seen through, and once the device behaves again it can be used.
  void check_recovery() {
    proxy.behave_well();
    CHECK(devices.gantry->stop());
    CHECK(devices.gantry->move_to({1, 2, 3, 4}).in_position);
  }
};

bool is_poll(const Frame& request, int unit) {
  return unit_of(request) == unit && function_of(request) == 3 && address_of(request) == poll_register;
}

}  // namespace

TEST_CASE("The drivers keep the device contract with emulated devices in the same process") {
  EmbeddedBench b(moving_bench());
  ConnectedBench devices = connect(b.bench, b.clock);
  check_device_contract(devices, b.bench);
}

TEST_CASE("The drivers keep the device contract with emulated devices in another process, on its clock") {
  const BenchProcess process(moving_bench());
  ConnectedBench devices = connect(process.bench());
  CHECK(devices.clock->is_virtual());
  const BenchTime before = devices.clock->now();
  devices.clock->sleep_until(before + second);
  CHECK(devices.clock->now() == before + second);
  devices.clock->sleep_until(0);  // never back
  CHECK(devices.clock->now() == before + second);
  check_device_contract(devices, process.bench());
}

TEST_CASE("The gantry keeps its contract on the real clock") {
  EmbeddedBench b(ideal_bench(), sample(), std::make_shared<RealClock>());
  for (Axis& axis : b.bench.axes) axis.speed_deg_per_s = axis.acceleration_deg_per_s2 = 2000;  // this bench takes no time to move
  ConnectedBench devices = connect(b.bench);
  CHECK_FALSE(devices.clock->is_virtual());
  check_gantry_contract(*devices.gantry, b.bench);
}

TEST_CASE("A refused write is a device error that names unit and register") {
  ProxiedBench b;
  const std::string text = b.failure_of_a_move([](const Frame& request, const auto& forward) -> std::optional<Frame> {
    if (unit_of(request) == 2 && function_of(request) == 16) return exception_to(request, 4);
    return forward(request);
  });
  CHECK(text.find("unit 2 register " + std::to_string(target_register)) != std::string::npos);
  b.check_recovery();
}

TEST_CASE("A target that reads back otherwise is never started") {
  ProxiedBench b;
  int starts = 0;
  const std::string text = b.failure_of_a_move([&](const Frame& request, const auto& forward) -> std::optional<Frame> {
    if (unit_of(request) == 3 && function_of(request) == 16 && address_of(request) == control_register) ++starts;
    Frame answer = forward(request);
    if (unit_of(request) == 3 && function_of(request) == 3 && address_of(request) == target_register) set_answered(answer, 1, 0x1234);
    return answer;
  });
  CHECK(text.find("read back") != std::string::npos);
  CHECK(starts == 0);
  b.check_recovery();
}

TEST_CASE("A fault of a drive is reported with its code and text") {
  ProxiedBench b;
  const std::string text = b.failure_of_a_move([](const Frame& request, const auto& forward) -> std::optional<Frame> {
    Frame answer = forward(request);
    if (is_poll(request, 1)) {
      set_answered(answer, error_index, 0x7305);
      set_answered(answer, status_index, 0x0008);
    }
    return answer;
  });
  CHECK(text.find("0x7305") != std::string::npos);
  CHECK(text.find("position sensor") != std::string::npos);
  CHECK(text.find("axis platform") != std::string::npos);
  b.check_recovery();
}

TEST_CASE("An axis that does not arrive is given up in bench time, not for ever") {
  ProxiedBench b;
  const BenchTime begin = b.embedded.clock->now();
  const std::string text = b.failure_of_a_move([](const Frame& request, const auto& forward) -> std::optional<Frame> {
    Frame answer = forward(request);
    if (is_poll(request, 4)) {
      set_answered(answer, position_index, 0);
      set_answered(answer, position_index + 1, 77);
    }
    return answer;
  });
  CHECK(text.find("axis detector_zenith") != std::string::npos);
  CHECK(text.find("position 77") != std::string::npos);
  CHECK(seconds(b.embedded.clock->now() - begin) < 10);
  b.check_recovery();
}

TEST_CASE("An arrival bit alone is not believed, nor a position alone") {
  for (const bool lie_about_status : {true, false}) {
    ProxiedBench b;
    b.failure_of_a_move([=](const Frame& request, const auto& forward) -> std::optional<Frame> {
      Frame answer = forward(request);
      if (!is_poll(request, 2)) return answer;
      if (lie_about_status) {
        set_answered(answer, status_index, answered(answer, status_index) & ~0x0400);
      } else {
        set_answered(answer, position_index + 1, answered(answer, position_index + 1) + 5);
      }
      return answer;
    });
    b.check_recovery();
  }
}

TEST_CASE("A dropped connection is opened anew and the move goes on") {
  ProxiedBench b;
  std::atomic<int> requests = 0;
  b.proxy.behave([&](const Frame& request, const auto& forward) -> std::optional<Frame> {
    if (++requests % 7 == 0) return std::nullopt;
    return forward(request);
  });
  CHECK(b.devices.gantry->move_to({20, -20, 30, 40}).in_position);
  CHECK(requests > 14);
  b.proxy.behave([](const Frame&, const auto&) { return std::nullopt; });
  std::string text;
  CHECK(error_kind([&] { b.devices.gantry->move_to({1, 1, 1, 1}); }, &text) == ErrorKind::device);
  CHECK(text.find("127.0.0.1:" + std::to_string(b.bench.modbus.port)) != std::string::npos);
  CHECK_FALSE(b.devices.gantry->stop());  // nobody answers: not seen at rest
  b.check_recovery();
}

TEST_CASE("A late answer is never taken for the answer to another request") {
  EmbeddedBench embedded(ideal_bench());
  ModbusProxy proxy(embedded.bench.modbus.port);
  modbus::Bus bus({"127.0.0.1", proxy.port()}, {.response_timeout_s = 0.05, .attempts = 3});
  // Every fifth answer is held back and comes with the one after it.
  Frame held;
  int requests = 0;
  proxy.behave([&](const Frame& request, const auto& forward) -> std::optional<Frame> {
    Frame answer = forward(request);
    if (++requests % 5 == 0) {
      held = std::move(answer);
      return Frame{};
    }
    Frame late = std::exchange(held, {});
    late.insert(late.end(), answer.begin(), answer.end());
    return late;
  });
  for (int k = 0; k < 20; ++k) {
    const std::array<std::uint16_t, 2> wanted{static_cast<std::uint16_t>(k), static_cast<std::uint16_t>(1000 + k)};
    const int unit = 1 + k % 4;
    bus.write(unit, target_register, wanted);
    std::array<std::uint16_t, 2> found{};
    bus.read(unit, target_register, found);
    CHECK(found == wanted);
  }
  CHECK(bus.counts().retries > 0);
  CHECK(bus.counts().reconnects > 0);
}

TEST_CASE("A bench that does not answer, a missing unit and a busy port are named") {
  Bench bench = ideal_bench();
  std::string text;
  {
    EmbeddedBench embedded(bench);
    bench = embedded.bench;
    Bench other = bench;
    other.axes[2].unit = 99;
    CHECK(error_kind([&] { connect(other, embedded.clock); }, &text) == ErrorKind::device);
    CHECK(text.find("unit 99") != std::string::npos);
    CHECK(error_kind([&] { simulated::SimulatedBench(bench, sample(), embedded.clock); }, &text) == ErrorKind::device);
    CHECK(text.find(std::to_string(bench.modbus.port)) != std::string::npos);
    other = bench;
    other.expected_idn = "ACME";
    CHECK(error_kind([&] { connect(other, embedded.clock); }, &text) == ErrorKind::device);
    CHECK(text.find("ACME") != std::string::npos);
  }
  CHECK(error_kind([&] { connect(bench); }, &text) == ErrorKind::device);
  CHECK(text.find("127.0.0.1:" + std::to_string(bench.modbus.port)) != std::string::npos);
}

TEST_CASE("A wrong register image is noticed before anything moves") {
  EmbeddedBench embedded(moving_bench());
  Bench wrong = embedded.bench;
  wrong.axes[1].profile.velocity.address = 6040;
  std::string text;
  CHECK(error_kind([&] { connect(wrong, embedded.clock); }, &text) == ErrorKind::device);
  CHECK(text.find("register 6040") != std::string::npos);
}

TEST_CASE("A fault in the middle of a sweep closes the shutter, stops the arms, keeps the data, and the sweep can be resumed") {
  TemporaryFolder folder;
  ProxiedBench b;
  const SweepPlan plan = small_plan(b.bench, 20);
  Run run = Run::create(folder / "run.gonio", b.bench, {}, plan);
  int starts = 0;
  bool broken = false;
  b.proxy.behave([&](const Frame& request, const auto& forward) -> std::optional<Frame> {
    if (function_of(request) == 16 && address_of(request) == control_register && unit_of(request) == 4 && ++starts == 20) broken = true;
    Frame answer = forward(request);
    // From then on one drive answers polls with a fault, while the others are moving.
    if (broken && is_poll(request, 4)) {
      set_answered(answer, error_index, 0x8611);
      set_answered(answer, status_index, 0x0008);
    }
    return answer;
  });
  std::string text;
  const auto measure = [&] { sweep(run, plan, *b.devices.gantry, *b.devices.detector, *b.devices.source, *b.devices.clock, {}); };
  CHECK(error_kind(measure, &text) == ErrorKind::device);
  CHECK(text.find("position following error") != std::string::npos);
  const std::size_t kept = run.accepted_steps().size();
  CHECK((kept > 2 && kept < plan.steps.size()));
  CHECK(run.events().back().text.starts_with("shutter closed, arms at rest"));

  // Seen from another connection: the shutter is closed and every drive was halted.
  modbus::Bus bus(b.embedded.bench.modbus);
  CHECK(bus.read(b.bench.io_unit, modbus::io_unit::shutter) == 0);
  for (const Axis& axis : b.bench.axes) CHECK((bus.read(axis.unit, control_register) & 0x0100) != 0);

  b.proxy.behave_well();
  ConnectedBench again = connect(b.bench, b.embedded.clock);
  const SweepResult rest = sweep(run, plan, *again.gantry, *again.detector, *again.source, *again.clock, {});
  CHECK(rest.skipped == kept);
  CHECK(run.accepted_steps().size() == plan.steps.size());
}

TEST_CASE("The emulated server refuses what a drive would refuse") {
  const EmbeddedBench b(ideal_bench());
  modbus::Bus bus(b.bench.modbus);
  const std::uint16_t one = 1;
  CHECK(error_kind([&] { bus.read(1, 100); }) == ErrorKind::device);                          // no such register
  CHECK(error_kind([&] { bus.write(1, poll_register, {&one, 1}); }) == ErrorKind::device);    // read only
  CHECK(error_kind([&] { bus.write(b.bench.io_unit, 2, {&one, 1}); }) == ErrorKind::device);  // the lamp
  std::array<std::uint16_t, 126> too_many{};
  CHECK(error_kind([&] { bus.read(1, poll_register, too_many); }) == ErrorKind::device);
  bus.write(b.bench.io_unit, 0, {&one, 1}, 6);  // a single register by function 6
  std::uint16_t found = 0;
  bus.read(b.bench.io_unit, 0, {&found, 1}, 4);  // and by function 4
  CHECK(found == 1);
}
