// SPDX-License-Identifier: BSD-3-Clause
// The emulated meter's commands, settings and error queue.
#include "acquisition/simulated/power_meter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "acquisition/scpi_power_meter.hpp"

namespace gonio::acquisition::simulated {
namespace {

constexpr std::size_t longest_error_queue = 30;
constexpr double minimum_wavelength_nm = 200, maximum_wavelength_nm = 2500;
constexpr double minimum_range_w = 1e-12, maximum_range_w = 1e3;
constexpr double maximum_samples = 1'000'000;
constexpr const char *over_range = "9.9E37", *not_a_number = "9.91E37";

std::string upper(std::string_view text) {
  std::string s(text);
  for (char& c : s) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return s;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// `word` is the short (capital letters) or the long form of a node such as "WAVelength"; nothing in between.
bool is_node(std::string_view word, std::string_view node) {
  const std::string asked = upper(word);
  const auto short_length = std::ranges::find_if(node, [](char c) { return c >= 'a' && c <= 'z'; }) - node.begin();
  return asked == node.substr(0, static_cast<std::size_t>(short_length)) || asked == upper(node);
}

bool is_header(std::string_view header, std::string_view pattern) {
  const auto words = split(header, ':'), nodes = split(pattern, ':');
  return std::ranges::equal(words, nodes, is_node);
}

}  // namespace

/// One header; `query` and `set` are null where the form does not exist.
struct PowerMeter::Command {
  std::string_view pattern;
  std::string (*query)(PowerMeter&, std::unique_lock<std::mutex>&);
  void (*set)(PowerMeter&, std::string_view parameter);
};

const std::vector<PowerMeter::Command>& PowerMeter::commands() {
  using Lock = std::unique_lock<std::mutex>;
  static const std::vector<Command> list{
      {"*IDN", [](PowerMeter& m, Lock&) { return m.bench_.expected_idn; }, nullptr},
      {"*CLS", nullptr, [](PowerMeter& m, std::string_view) { m.errors_.clear(); }},
      {"*RST", nullptr, [](PowerMeter& m, std::string_view) { m.reset(); }},
      {"*OPC", [](PowerMeter&, Lock&) { return std::string("1"); }, nullptr},
      {"SYSTem:ERRor",
       [](PowerMeter& m, Lock&) {
         if (m.errors_.empty()) return std::string("0,\"No error\"");
         std::string first = std::move(m.errors_.front());
         m.errors_.pop_front();
         return first;
       },
       nullptr},
      {"ABORt", nullptr, [](PowerMeter& m, std::string_view) { m.acquisition_.reset(); }},
      {"INITiate", nullptr,
       [](PowerMeter& m, std::string_view) {
         m.acquisition_ = {m.clock_->now(), m.samples_ * ScpiPowerMeter::sample_s, std::nullopt};
       }},
      {"FETCh", [](PowerMeter& m, Lock& lock) { return m.fetch(lock); }, nullptr},
      {"SENSe:CORRection:WAVelength", [](PowerMeter& m, Lock&) { return m.print(m.wavelength_nm_); },
       [](PowerMeter& m, std::string_view p) {
         if (const auto v = m.number(p, minimum_wavelength_nm, maximum_wavelength_nm)) m.wavelength_nm_ = *v;
       }},
      {"SENSe:POWer:RANGe:UPPer", [](PowerMeter& m, Lock&) { return m.print(m.range_w_); },
       [](PowerMeter& m, std::string_view p) {
         if (const auto v = m.number(p, minimum_range_w, maximum_range_w)) m.range_w_ = *v;
       }},
      {"SENSe:AVERage:COUNt", [](PowerMeter& m, Lock&) { return std::to_string(m.samples_); },
       [](PowerMeter& m, std::string_view p) {
         if (const auto v = m.number(p, 1, maximum_samples)) m.samples_ = static_cast<int>(std::lround(*v));
       }},
  };
  return list;
}

PowerMeter::PowerMeter(const Bench& bench, std::shared_ptr<Clock> clock, std::function<double(BenchTime, double)> signal_w)
    : bench_(bench), clock_(std::move(clock)), signal_w_(std::move(signal_w)) {
  reset();
}

void PowerMeter::reset() {
  wavelength_nm_ = bench_.wavelength_nm;
  range_w_ = maximum_range_w;
  samples_ = 1;
  acquisition_.reset();
}

void PowerMeter::raise(int code, const char* text) {
  // SCPI-99 vol. 2, 21.8.1: a full queue keeps its oldest entries and ends with the overflow.
  if (errors_.size() < longest_error_queue) {
    errors_.push_back(fmt::format("{},\"{}\"", code, text));
  } else {
    errors_.back() = "-350,\"Queue overflow\"";
  }
}

void PowerMeter::interrupted() {
  const std::lock_guard lock(mutex_);
  raise(-410, "Query INTERRUPTED");
}

void PowerMeter::unterminated() {
  const std::lock_guard lock(mutex_);
  raise(-420, "Query UNTERMINATED");
}

std::optional<double> PowerMeter::number(std::string_view parameter, double minimum, double maximum) {
  const std::string word = upper(parameter);
  if (word == "MIN" || word == "MINIMUM") return minimum;
  if (word == "MAX" || word == "MAXIMUM") return maximum;
  if (word.empty()) {
    raise(-109, "Missing parameter");
    return std::nullopt;
  }
  double value = 0;
  const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
  const auto [end, code] = std::from_chars(begin, word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
    raise(-104, "Data type error");
    return std::nullopt;
  }
  if (value < minimum || value > maximum) {
    raise(-222, "Data out of range");
    return std::nullopt;
  }
  return value;
}

std::string PowerMeter::print(double value) const { return fmt::format("{:.{}E}", value, bench_.simulated.meter_digits - 1); }

std::string PowerMeter::fetch(std::unique_lock<std::mutex>& lock) {
  if (!acquisition_) {
    raise(-230, "Data corrupt or stale");
    return not_a_number;
  }
  if (!acquisition_->value) {
    // The exposure is still running: wait in the caller's name, with the meter free for others.
    const auto [start, exposure_s, unknown] = *acquisition_;
    lock.unlock();
    clock_->sleep_until(start + bench_time(exposure_s));
    const double value = signal_w_(start, exposure_s);
    lock.lock();
    if (!acquisition_ || acquisition_->start != start) {  // aborted from another connection meanwhile
      raise(-230, "Data corrupt or stale");
      return not_a_number;
    }
    acquisition_->value = value;
  }
  const double value = *acquisition_->value;
  if (std::isnan(value)) {
    raise(-230, "Data corrupt or stale");
    return not_a_number;
  }
  return std::abs(value) > range_w_ ? over_range : print(value);
}

std::optional<std::string> PowerMeter::execute_one(std::string_view header, std::string_view parameter, bool is_query) {
  std::unique_lock lock(mutex_);
  const auto& list = commands();
  const auto command = std::ranges::find_if(
      list, [&](const Command& c) { return is_header(header, c.pattern) && (is_query ? c.query != nullptr : c.set != nullptr); });
  if (command == list.end()) {
    raise(-113, "Undefined header");
    return std::nullopt;
  }
  if (!is_query) {
    command->set(*this, parameter);
    return std::nullopt;
  }
  if (!parameter.empty()) {
    raise(-108, "Parameter not allowed");
    return std::nullopt;
  }
  return command->query(*this, lock);
}

std::optional<std::string> PowerMeter::execute(std::string_view line) {
  std::optional<std::string> answers;
  std::string path;  // of the command before, with its last colon
  for (std::string_view unit : split(line, ';')) {
    unit = trimmed(unit);
    if (unit.empty()) continue;
    const auto space = std::min(unit.find_first_of(" \t"), unit.size());
    std::string header(unit.substr(0, space));
    const std::string_view parameter = trimmed(unit.substr(space));
    const bool is_query = header.ends_with('?');
    if (is_query) header.pop_back();
    if (header.starts_with(':')) {
      header.erase(0, 1);
    } else if (!header.starts_with('*')) {
      header.insert(0, path);
    }
    if (!header.starts_with('*')) path = header.substr(0, header.find_last_of(':') + 1);
    if (const auto answer = execute_one(header, parameter, is_query)) answers = answers ? *answers + ';' + *answer : *answer;
  }
  return answers;
}

}  // namespace gonio::acquisition::simulated
