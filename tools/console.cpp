// SPDX-License-Identifier: BSD-3-Clause
#include "tools/console.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace gonio::tools {
namespace {

bool on_terminal() {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  return terminal;
}

}  // namespace

void Console::print(std::string_view line) const { std::cout << line << '\n'; }

void Console::print_json(const Json& document) const { std::cout << document.dump(2) << '\n'; }

void Console::note(std::string_view line) const {
  if (!quiet) std::cerr << line << '\n';
}

void Console::progress(std::string_view line) const {
  if (quiet) return;
  if (on_terminal())
    std::cerr << "\r\033[K" << line << std::flush;
  else if (!line.empty())
    std::cerr << line << '\n';
}

std::chrono::milliseconds Console::progress_interval() const { return std::chrono::milliseconds(on_terminal() ? 500 : 10000); }

void Console::note_masked(const std::string& file, const MaskedCounts& masked) const {
  if (masked.total() == 0) return;
  std::ostringstream text;
  text << file << ": " << masked.total() << " entries are no measurement (" << masked.nan << " nan, " << masked.missing << " missing, "
       << masked.below_horizon << " below the horizon, " << masked.blocked << " blocked)";
  note(text.str());
}

void add_common(CLI::App& app, Console& console) {
  app.add_flag("--json", console.json, "Print one JSON document instead of text");
  app.add_flag("--quiet", console.quiet, "No progress, no notes");
}

bool parse(CLI::App& app, const Arguments& arguments) {
  Arguments reversed(arguments.rbegin(), arguments.rend());  // CLI11 takes them from the back
  try {
    app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return false;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::usage, {"gonio " + app.get_name(), error.what(), "see gonio " + app.get_name() + " --help"});
  }
  return true;
}

std::pair<std::string, std::string> name_value(const std::string& text, const std::string& flag) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw Error(ErrorKind::usage, {flag, "'" + text + "'", "NAME=VALUE"});
  return {text.substr(0, equals), text.substr(equals + 1)};
}

double number_from(const std::string& text, const std::string& flag) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) throw Error(ErrorKind::usage, {flag, "'" + text + "'", "a number"});
  return value;
}

std::vector<std::string> comma_separated(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

int exit_code(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::usage: return 2;
    case ErrorKind::input: return 3;
    case ErrorKind::limit: return 4;
    case ErrorKind::device: return 5;
    case ErrorKind::interrupted: return 6;
    case ErrorKind::internal: return 70;
  }
  return 70;
}

Json error_document(const Error& error) {
  Json faults = Json::array();
  for (const Fault& fault : error.faults())
    faults.push_back(Json::object({{"where", fault.where}, {"found", fault.found}, {"wanted", fault.wanted}}));
  return Json::object({{"error", Json::object({{"kind", name(error.kind())}, {"message", error.message()}, {"faults", faults}})}});
}

}  // namespace gonio::tools
