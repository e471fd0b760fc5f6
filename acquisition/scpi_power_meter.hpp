// SPDX-License-Identifier: BSD-3-Clause
// An optical power meter that speaks SCPI over a raw TCP socket.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "acquisition/bench.hpp"
#include "acquisition/devices.hpp"
#include "acquisition/tcp_stream.hpp"

namespace gonio::acquisition {

/// The subset common to bench power meters: *IDN? *CLS SYST:ERR? ABOR INIT FETC? SENS:CORR:WAV SENS:POW:RANG:UPP SENS:AVER:COUN.
///
/// Every setting is queried back, the error queue is read after each exchange, and no query is sent before the reply of the one
/// before has been read. The exposure is a number of averaged samples of `sample_s` each. A reading is the *mean power* over the
/// exposure: it does not grow with the exposure. After a failure the connection is opened and configured anew by the next call.
class ScpiPowerMeter final : public Detector {
 public:
  /// Time of one sample of the averaging counter.
  static constexpr double sample_s = 0.0003;
  /// Samples whose mean is one reading; at least 1.
  static int samples(double exposure_s) noexcept;

  /// Connects; Error(device) if nobody answers or the identity does not begin with `expected_idn`. `timeout_s` is steady time.
  ScpiPowerMeter(Endpoint endpoint, std::string expected_idn, double timeout_s = 5);

  std::string identity() override;
  void configure(double wavelength_nm, double range_w, double exposure_s) override;
  double read(double exposure_s) override;

 private:
  struct Settings {
    double wavelength_nm, range_w, exposure_s;
  };
  void open();
  void apply(const Settings& settings);
  void set(const std::string& header, double value);
  std::string ask(const std::string& query, double patience_s = 0);
  double ask_number(const std::string& query, double patience_s = 0);
  void require_no_error(const std::string& after);
  template <class Exchange>
  auto guarded(Exchange exchange);

  Endpoint endpoint_;
  std::string expected_idn_, identity_;
  double timeout_s_;
  std::unique_ptr<TcpStream> stream_;  ///< none after a failure
  std::optional<Settings> settings_;
};

}  // namespace gonio::acquisition
