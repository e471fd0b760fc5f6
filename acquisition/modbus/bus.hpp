// SPDX-License-Identifier: BSD-3-Clause
// One Modbus TCP connection with one owner: reads, and writes that are read back.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "acquisition/bench.hpp"

struct _modbus;  // libmodbus' connection; its header stays in the .cpp

namespace gonio::acquisition::modbus {

/// Time on the steady clock, never bench time.
struct BusOptions {
  double response_timeout_s = 2;  ///< some drives need more than libmodbus' default of 0.5 s
  int attempts = 3;               ///< of every request: all requests are idempotent (absolute targets only)
};

/// How often the link needed help since it was opened.
struct BusCounts {
  std::uint64_t requests = 0, retries = 0, reconnects = 0;
};

/// Registers of the units behind one host:port: function codes 03 and 16 unless the caller says 04 (input registers) or 06 (one register).
///
/// An acknowledged write proves little: libmodbus checks an answer to function 16 by its count only, so a stale answer can confirm
/// another write. So `write` always reads back and compares. After a time-out or a broken connection the link is opened anew before
/// the request is repeated; on TCP the transaction id then keeps late answers out (libmodbus alone never recovers from one).
/// Every failure is an Error(device) that names host:port, unit and register.
class Bus {
 public:
  explicit Bus(Endpoint endpoint, BusOptions options = {});
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Reads `values.size()` (at most 125) registers from `address` on, with function 3 or 4.
  void read(int unit, int address, std::span<std::uint16_t> values, int function = 3);
  std::uint16_t read(int unit, int address);
  /// Writes with function 16 or (a single register) 6, and reads back with function 3; Error(device) if the read-back differs after
  /// every attempt.
  void write(int unit, int address, std::span<const std::uint16_t> values, int function = 16);
  /// Writes without reading back, for registers that are meant to read otherwise than written.
  void write_unverified(int unit, int address, std::span<const std::uint16_t> values, int function = 16);

  BusCounts counts() const;
  /// "host:port unit U register R"
  std::string where(int unit, int address) const;

 private:
  void transfer(int function, int unit, int address, std::span<std::uint16_t> values);
  bool open();  // errno tells why not
  void close() noexcept;

  struct Closer {
    void operator()(_modbus* context) const noexcept;
  };

  Endpoint endpoint_;
  BusOptions options_;
  mutable std::mutex mutex_;
  std::unique_ptr<_modbus, Closer> context_;
  bool connected_ = false;
  BusCounts counts_;
};

}  // namespace gonio::acquisition::modbus
