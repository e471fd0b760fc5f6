// SPDX-License-Identifier: BSD-3-Clause
// Requests over libmodbus with retries, a fresh connection after each broken one, and read-back of what was written.
#include "acquisition/modbus/bus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <modbus.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "brdf/error.hpp"

namespace gonio::acquisition::modbus {
namespace {

/// The slave answered with an exception: the link is sound.
bool is_exception(int error) { return error >= EMBXILFUN && error <= EMBXGTAR; }
/// An exception that another attempt cannot change (illegal function, address, value).
bool is_final(int error) { return error == EMBXILFUN || error == EMBXILADD || error == EMBXILVAL; }

/// Registers transferred, or -1 with errno set.
int request(modbus_t* context, int function, int address, std::span<std::uint16_t> values) {
  const int count = static_cast<int>(values.size());
  switch (function) {
    case 3: return modbus_read_registers(context, address, count, values.data());
    case 4: return modbus_read_input_registers(context, address, count, values.data());
    case 6: return modbus_write_register(context, address, values.front());
    default: return modbus_write_registers(context, address, count, values.data());
  }
}

}  // namespace

void Bus::Closer::operator()(_modbus* context) const noexcept { modbus_free(context); }

Bus::Bus(Endpoint endpoint, BusOptions options) : endpoint_(std::move(endpoint)), options_(options) {
  const std::string service = std::to_string(endpoint_.port);
  context_.reset(modbus_new_tcp_pi(endpoint_.host.c_str(), service.c_str()));
  if (!context_) {
    throw Error(ErrorKind::device,
                Fault{fmt::format("{}:{}", endpoint_.host, endpoint_.port), modbus_strerror(errno), "a host and a port"});
  }
  const auto whole = static_cast<std::uint32_t>(options_.response_timeout_s);
  const auto micro = static_cast<std::uint32_t>((options_.response_timeout_s - whole) * 1e6);
  modbus_set_response_timeout(context_.get(), whole, micro);
  if (!open()) {
    throw Error(ErrorKind::device,
                Fault{fmt::format("{}:{}", endpoint_.host, endpoint_.port), modbus_strerror(errno), "a Modbus TCP server that answers"});
  }
}

Bus::~Bus() { close(); }

bool Bus::open() {
  connected_ = modbus_connect(context_.get()) == 0;
  if (!connected_) {
    const int error = errno;
    modbus_close(context_.get());
    errno = error;
  }
  return connected_;
}

void Bus::close() noexcept {
  if (connected_) modbus_close(context_.get());
  connected_ = false;
}

std::string Bus::where(int unit, int address) const {
  return fmt::format("{}:{} unit {} register {}", endpoint_.host, endpoint_.port, unit, address);
}

BusCounts Bus::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void Bus::transfer(int function, int unit, int address, std::span<std::uint16_t> values) {
  const std::lock_guard lock(mutex_);
  const int count = static_cast<int>(values.size());
  std::string reason;
  for (int attempt = 0; attempt < options_.attempts; ++attempt) {
    if (attempt > 0) ++counts_.retries;
    if (!connected_) {
      ++counts_.reconnects;
      if (!open()) {
        reason = modbus_strerror(errno);
        continue;
      }
    }
    modbus_set_slave(context_.get(), unit);
    ++counts_.requests;
    if (request(context_.get(), function, address, values) == count) return;
    const int error = errno;
    reason = modbus_strerror(error);
    if (is_final(error)) break;
    if (!is_exception(error)) close();
  }
  throw Error(ErrorKind::device, Fault{where(unit, address), reason,
                                       fmt::format("an answer to function {} with {} register{}", function, count, count == 1 ? "" : "s")});
}

void Bus::read(int unit, int address, std::span<std::uint16_t> values, int function) { transfer(function, unit, address, values); }

std::uint16_t Bus::read(int unit, int address) {
  std::uint16_t value = 0;
  read(unit, address, {&value, 1});
  return value;
}

void Bus::write_unverified(int unit, int address, std::span<const std::uint16_t> values, int function) {
  std::vector<std::uint16_t> copy(values.begin(), values.end());
  transfer(function, unit, address, copy);
}

void Bus::write(int unit, int address, std::span<const std::uint16_t> values, int function) {
  std::vector<std::uint16_t> back(values.size());
  for (int attempt = 0; attempt < options_.attempts; ++attempt) {
    write_unverified(unit, address, values, function);
    read(unit, address, back);
    if (std::ranges::equal(back, values)) return;
  }
  throw Error(ErrorKind::device, Fault{where(unit, address), fmt::format("read back {}", fmt::join(back, " ")),
                                       fmt::format("{} as written", fmt::join(values, " "))});
}

}  // namespace gonio::acquisition::modbus
