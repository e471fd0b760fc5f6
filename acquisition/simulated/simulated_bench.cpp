// SPDX-License-Identifier: BSD-3-Clause
// The two servers of the simulated bench and the state behind them.
#include "acquisition/simulated/simulated_bench.hpp"

#include <fmt/format.h>
#include <modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>
#include <mutex>

#include "acquisition/kinematics.hpp"
#include "acquisition/simulated/drive_unit.hpp"
#include "acquisition/simulated/io_units.hpp"
#include "acquisition/simulated/listener.hpp"
#include "acquisition/simulated/optics.hpp"
#include "acquisition/simulated/power_meter.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition::simulated {
namespace {

enum Function : std::uint8_t { read_holding = 0x03, read_input = 0x04, write_single = 0x06, write_multiple = 0x10 };
constexpr std::size_t longest_line = 65536;

/// Fields of a request after the MBAP header (Modbus messaging on TCP/IP V1.0b, 3.1.3).
struct Request {
  int unit, function, address, count;
  bool is_write() const { return function == write_single || function == write_multiple; }
  bool is_read() const { return function == read_holding || function == read_input; }
};

Request parse(const std::uint8_t* frame) {
  Request r{frame[6], frame[7], frame[8] << 8 | frame[9], 1};
  if (r.function != write_single) r.count = frame[10] << 8 | frame[11];
  return r;
}

}  // namespace

struct SimulatedBench::Server {
  Server(const Bench& bench, std::shared_ptr<const Brdf> sample, std::shared_ptr<Clock> bench_clock)
      : clock(std::move(bench_clock)),
        kinematics(make_kinematics(bench)),
        optics(bench, std::move(sample)),
        clock_unit(clock),
        meter(bench, clock, [this](BenchTime start, double exposure_s) { return signal_w(start, exposure_s); }) {
    const auto add = [&](int number, RegisterUnit& unit, const std::string& what) {
      if (!units.emplace(number, &unit).second) {
        throw Error(ErrorKind::input,
                    Fault{"bench", fmt::format("Modbus unit {} twice ({})", number, what), "a unit of its own for each device"});
      }
    };
    add(modbus::clock_unit::unit, clock_unit, "clock");
    add(bench.io_unit, io, "I/O");
    drives.reserve(bench.axes.size());
    for (const Axis& axis : bench.axes) add(axis.unit, drives.emplace_back(axis, bench.simulated.motion), "axis " + axis.name);
    modbus_listener.emplace(bench.modbus, [this](int socket) { serve_modbus(socket); });
    scpi_listener.emplace(bench.scpi, [this](int socket) { serve_scpi(socket); });
  }

  double signal_w(BenchTime start, double exposure_s) {
    Exposure e;
    {
      const std::lock_guard lock(mutex);
      e.middle = start + bench_time(exposure_s) / 2;
      AxisAngles axes;
      for (const DriveUnit& drive : drives) axes.push_back(drive.position_deg(e.middle));
      e.pose = kinematics->pose(axes);
      e.shutter_open = io.shutter_open();
      e.white_in_beam = io.white_in_beam();
      e.exposure_s = exposure_s;
      e.tag = clock_unit.tag();
    }
    return optics.signal_w(e);
  }

  void serve_modbus(int socket);
  void answer(modbus_t* connection, const std::uint8_t* frame, int length);
  void serve_scpi(int socket);

  std::shared_ptr<Clock> clock;
  std::unique_ptr<Kinematics> kinematics;
  Optics optics;

  std::mutex mutex;  // of all units
  IoUnit io;
  ClockUnit clock_unit;
  std::vector<DriveUnit> drives;
  std::map<int, RegisterUnit*> units;
  PowerMeter meter;

  std::optional<Listener> modbus_listener, scpi_listener;  // last: their threads use everything above
};

void SimulatedBench::Server::answer(modbus_t* connection, const std::uint8_t* frame, int length) {
  const Request request = parse(frame);
  const auto refuse = [&](unsigned code) { modbus_reply_exception(connection, frame, code); };
  const std::lock_guard lock(mutex);
  const auto found = units.find(request.unit);
  if (found == units.end()) return refuse(MODBUS_EXCEPTION_GATEWAY_TARGET);
  RegisterUnit& unit = *found->second;
  if (!request.is_read() && !request.is_write()) return refuse(MODBUS_EXCEPTION_ILLEGAL_FUNCTION);
  // Checked here although libmodbus would: it waits for half a second before it refuses a count.
  if (request.count < 1 || request.count > (request.is_read() ? MODBUS_MAX_READ_REGISTERS : MODBUS_MAX_WRITE_REGISTERS)) {
    return refuse(MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  }
  if (request.is_write()) {
    for (int k = 0; k < request.count; ++k) {
      if (!unit.is_writable(request.address + k)) return refuse(MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS);
    }
  }
  unit.refresh(clock->now());
  // One image for holding and input registers; libmodbus checks ranges and counts against it.
  modbus_mapping_t image{};
  image.start_registers = image.start_input_registers = unit.first();
  image.nb_registers = image.nb_input_registers = static_cast<int>(unit.registers().size());
  image.tab_registers = image.tab_input_registers = unit.registers().data();
  if (!request.is_write()) {
    modbus_reply(connection, frame, length, &image);
    return;
  }
  // The device acts before its answer leaves, so that whoever got the answer finds the command done.
  if (request.function == write_multiple && length < 13 + 2 * request.count) return refuse(MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  const std::uint8_t* values = frame + (request.function == write_single ? 10 : 13);
  for (int k = 0; k < request.count; ++k) {
    unit.registers()[static_cast<std::size_t>(request.address + k - unit.first())] =
        static_cast<std::uint16_t>(values[2 * k] << 8 | values[2 * k + 1]);
  }
  unit.written(request.address, request.count, clock->now());
  modbus_reply(connection, frame, length, &image);
}

void SimulatedBench::Server::serve_modbus(int socket) {
  modbus_t* connection = modbus_new_tcp("127.0.0.1", 0);
  modbus_set_socket(connection, socket);
  std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> frame{};
  for (;;) {
    const int length = modbus_receive(connection, frame.data());
    if (length < 0) break;
    if (length > 0) answer(connection, frame.data(), length);
  }
  modbus_free(connection);
}

void SimulatedBench::Server::serve_scpi(int socket) {
  std::string received;
  for (;;) {
    std::array<char, 4096> buffer{};
    const ssize_t n = recv(socket, buffer.data(), buffer.size(), 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    received.append(buffer.data(), static_cast<std::size_t>(n));
    for (auto end = received.find('\n'); end != std::string::npos; end = received.find('\n')) {
      const std::string line = received.substr(0, end);
      received.erase(0, end + 1);
      auto answer = meter.execute(line);
      if (!answer) continue;
      if (received.find('\n') != std::string::npos) {
        meter.interrupted();
        continue;
      }
      *answer += '\n';
      if (send(socket, answer->data(), answer->size(), MSG_NOSIGNAL) != static_cast<ssize_t>(answer->size())) return;
    }
    if (received.size() > longest_line) break;
  }
  if (!received.empty()) meter.unterminated();
}

SimulatedBench::SimulatedBench(const Bench& bench, std::shared_ptr<const Brdf> sample, std::shared_ptr<Clock> clock)
    : server_(std::make_unique<Server>(bench, std::move(sample), std::move(clock))) {}

SimulatedBench::~SimulatedBench() { stop(); }

SimulatedBench::Ports SimulatedBench::ports() const { return {server_->modbus_listener->port(), server_->scpi_listener->port()}; }

void SimulatedBench::stop() noexcept {
  server_->modbus_listener->stop();
  server_->scpi_listener->stop();
}

}  // namespace gonio::acquisition::simulated
