// SPDX-License-Identifier: BSD-3-Clause
// How a verb talks: results on standard output, progress and notes on standard error, JSON for machines.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/dataset.hpp"
#include "brdf/error.hpp"
#include "data-schemas/json.hpp"

namespace CLI {
class App;
}

namespace gonio::tools {

/// What every verb can do with its terminal.
struct Console {
  bool json = false;   ///< the result is one JSON document
  bool quiet = false;  ///< no progress and no notes

  /// A line of the result.
  void print(std::string_view line) const;
  void print_json(const Json& document) const;
  /// A line for the person watching; not with --quiet.
  void note(std::string_view line) const;
  /// Replaces the line of progress (on a terminal) or adds one (elsewhere); empty ends it.
  void progress(std::string_view line) const;
  /// How often progress is worth a line: twice a second on a terminal, every ten seconds in a log.
  std::chrono::milliseconds progress_interval() const;
  /// One line about what was not used as a measurement, if there is any.
  void note_masked(const std::string& file, const MaskedCounts& masked) const;
};

using Arguments = std::vector<std::string>;

/// Adds --json and --quiet.
void add_common(CLI::App& app, Console& console);
/// Parses; prints help and returns false if it was asked for; Error(usage) otherwise.
bool parse(CLI::App& app, const Arguments& arguments);

/// Splits NAME=VALUE; Error(usage) naming `flag` if there is no `=`.
std::pair<std::string, std::string> name_value(const std::string& text, const std::string& flag);
/// A number and nothing else; Error(usage) naming `flag`.
double number_from(const std::string& text, const std::string& flag);
/// Splits at commas; no empty parts.
std::vector<std::string> comma_separated(const std::string& text);

/// The documented exit code of an error: usage 2, input 3, limit 4, device 5, interrupted 6, internal 70.
int exit_code(ErrorKind kind) noexcept;
/// `{"error":{"kind","message","faults":[{"where","found","wanted"}]}}`
Json error_document(const Error& error);

}  // namespace gonio::tools
