// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_metadata.hpp"

#include <fmt/format.h>

namespace gonio::tabulated {
namespace {

std::string escaped(std::string_view text, bool key) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\\\";
    else if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == ':' && key)
      out += "\\:";
    else
      out += c;
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\' || at + 1 == text.size()) {
      out += text[at];
      continue;
    }
    const char c = text[++at];
    out += c == 'n' ? '\n' : c == 'r' ? '\r' : c;
  }
  return out;
}

std::size_t unescaped_colon(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\\')
      ++at;
    else if (text[at] == ':')
      return at;
  }
  return std::string_view::npos;
}

}  // namespace

void read_metadata_line(std::string_view line, std::size_t number, CsvMetadata& metadata, FaultList& faults) {
  if (line == csv_signature && number == 1) {
    metadata.ours = true;
    return;
  }
  if (!metadata.ours || !line.starts_with("# ")) return;
  const std::string_view text = line.substr(2);
  const std::size_t colon = unescaped_colon(text);
  if (colon == std::string_view::npos) return;
  const std::string key = unescaped(text.substr(0, colon));
  std::string_view value = text.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (!read_metadata_entry(key, unescaped(value), metadata)) faults.add_at(number, excerpt(line), "a known key with a value of its kind");
}

std::string metadata_lines(const Dataset& dataset) {
  std::string out = fmt::format("{}\n", csv_signature);
  for (const auto& [key, value] : metadata_entries(dataset)) out += fmt::format("# {}: {}\n", escaped(key, true), escaped(value, false));
  return out;
}

}  // namespace gonio::tabulated
