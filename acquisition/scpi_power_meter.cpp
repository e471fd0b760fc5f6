// SPDX-License-Identifier: BSD-3-Clause
// The power meter's dialogue: set, query back, look at the error queue.
#include "acquisition/scpi_power_meter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "brdf/error.hpp"

namespace gonio::acquisition {
namespace {

constexpr double over_range = 9.9e37;         // SCPI-99 vol. 1, 7.2.1.4: +infinity; not-a-number is 9.91e37
constexpr double printed_to_7_digits = 1e-6;  // a meter may print a setting with as few digits as IEEE single precision has
constexpr int longest_error_queue = 64;

}  // namespace

int ScpiPowerMeter::samples(double exposure_s) noexcept { return std::max(1, static_cast<int>(std::lround(exposure_s / sample_s))); }

ScpiPowerMeter::ScpiPowerMeter(Endpoint endpoint, std::string expected_idn, double timeout_s)
    : endpoint_(std::move(endpoint)), expected_idn_(std::move(expected_idn)), timeout_s_(timeout_s) {
  open();
}

void ScpiPowerMeter::open() {
  stream_ = std::make_unique<TcpStream>(endpoint_, timeout_s_);
  stream_->send_line("ABOR", timeout_s_);
  stream_->send_line("*CLS", timeout_s_);
  identity_ = ask("*IDN?");
  if (!identity_.starts_with(expected_idn_)) {
    throw Error(ErrorKind::device,
                Fault{stream_->peer() + " *IDN?", identity_, fmt::format("an identity that begins with '{}'", expected_idn_)});
  }
}

/// Runs an exchange on an open, configured connection; drops the connection if it fails, since an answer may still be on its way.
template <class Exchange>
auto ScpiPowerMeter::guarded(Exchange exchange) {
  try {
    if (!stream_) {
      open();
      if (settings_) apply(*settings_);
    }
    return exchange();
  } catch (...) {
    stream_.reset();
    throw;
  }
}

std::string ScpiPowerMeter::ask(const std::string& query, double patience_s) {
  stream_->send_line(query, timeout_s_);
  return stream_->receive_line(timeout_s_ + patience_s);
}

double ScpiPowerMeter::ask_number(const std::string& query, double patience_s) {
  const std::string answer = ask(query, patience_s);
  const char* begin = answer.data() + std::min(answer.find_first_not_of(" +"), answer.size());
  const char* end = answer.data() + answer.size();
  double value = 0;
  const auto [stopped, code] = std::from_chars(begin, end, value);
  if (code != std::errc{} || stopped != end || !std::isfinite(value)) {
    throw Error(ErrorKind::device, Fault{stream_->peer() + " " + query, fmt::format("'{}'", answer), "a number"});
  }
  return value;
}

void ScpiPowerMeter::require_no_error(const std::string& after) {
  std::vector<Fault> faults;
  for (int k = 0; k < longest_error_queue; ++k) {
    const std::string entry = ask("SYST:ERR?");
    if (entry.starts_with("0,") || entry.starts_with("+0,")) break;
    faults.push_back({fmt::format("{} after {}", stream_->peer(), after), entry, "no error"});
  }
  if (!faults.empty()) throw Error(ErrorKind::device, "the power meter reports an error", std::move(faults));
}

void ScpiPowerMeter::set(const std::string& header, double value) {
  stream_->send_line(fmt::format("{} {}", header, value), timeout_s_);
  const double back = ask_number(header + "?");
  require_no_error(header);
  if (std::abs(back - value) > printed_to_7_digits * std::abs(value)) {
    throw Error(ErrorKind::device, Fault{stream_->peer() + " " + header + "?", fmt::format("{}", back), fmt::format("{} as set", value)});
  }
}

void ScpiPowerMeter::apply(const Settings& s) {
  set("SENS:CORR:WAV", s.wavelength_nm);
  set("SENS:POW:RANG:UPP", s.range_w);
  set("SENS:AVER:COUN", samples(s.exposure_s));
}

std::string ScpiPowerMeter::identity() {
  return guarded([&] { return identity_; });
}

void ScpiPowerMeter::configure(double wavelength_nm, double range_w, double exposure_s) {
  settings_.reset();
  const Settings asked{wavelength_nm, range_w, exposure_s};
  guarded([&] { apply(asked); });
  settings_ = asked;
}

double ScpiPowerMeter::read(double exposure_s) {
  if (!settings_) throw Error(ErrorKind::internal, Fault{"power meter", "a reading before it was configured", "configure() first"});
  return guarded([&] {
    if (exposure_s != settings_->exposure_s) {
      set("SENS:AVER:COUN", samples(exposure_s));
      settings_->exposure_s = exposure_s;
    }
    stream_->send_line("INIT", timeout_s_);
    const double value = ask_number("FETC?", exposure_s);
    require_no_error("FETC?");
    if (std::abs(value) >= over_range) {
      throw Error(ErrorKind::device, Fault{stream_->peer() + " FETC?", fmt::format("{:g}, over range", value),
                                           fmt::format("at most {} W, the range set", settings_->range_w)});
    }
    return value;
  });
}

}  // namespace gonio::acquisition
