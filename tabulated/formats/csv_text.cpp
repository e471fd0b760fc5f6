// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_text.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace gonio::tabulated {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Position just after the closing quote of the quoted field that starts at `begin`; the end of the line if it is never closed.
std::size_t end_of_quoted(std::string_view line, std::size_t begin) {
  std::size_t at = begin + 1;
  while (at < line.size()) {
    if (line[at] != '"')
      ++at;
    else if (at + 1 < line.size() && line[at + 1] == '"')
      at += 2;
    else
      return at + 1;
  }
  return at;
}

std::string_view without_quotes(std::string_view field) {
  return field.size() >= 2 && field.front() == '"' && field.back() == '"' ? field.substr(1, field.size() - 2) : field;
}

}  // namespace

CsvLines::CsvLines(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

std::optional<std::string_view> CsvLines::next() {
  if (rest_.empty()) return std::nullopt;
  ++number_;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool is_empty_line(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#';
}

char separator_of(std::string_view row) {
  bool comma = false, tab = false;
  for (std::size_t at = 0; at < row.size() && row[at] != '#'; ++at) {
    if (row[at] == '"') at = end_of_quoted(row, at) - 1;
    if (row[at] == ';') return ';';  // wins over a decimal comma
    comma = comma || row[at] == ',';
    tab = tab || row[at] == '\t';
  }
  return comma ? ',' : tab ? '\t' : blanks;
}

void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  if (is_empty_line(line)) return;
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && (line[at] == ' ' || (line[at] == '\t' && separator != '\t'))) ++at;
  };
  const auto ended = [&] { return at >= line.size() || line[at] == '#'; };
  skip_blanks();
  while (true) {
    const std::size_t begin = at;
    if (!ended() && line[at] == '"') at = end_of_quoted(line, at);
    while (!ended() && (separator == blanks ? !is_blank(line[at]) : line[at] != separator)) ++at;
    fields.push_back(without_quotes(trimmed(line.substr(begin, at - begin))));
    if (separator == blanks) {
      skip_blanks();
      if (ended()) return;
    } else {
      if (ended()) return;
      ++at;
      skip_blanks();
    }
  }
}

std::string unquoted(std::string_view field) {
  std::string out;
  for (std::size_t at = 0; at < field.size(); ++at) {
    out += field[at];
    if (field[at] == '"' && at + 1 < field.size() && field[at + 1] == '"') ++at;
  }
  return out;
}

std::string as_field(std::string_view name) {
  if (!name.empty() && name.find_first_of(" \t,;#\"") == std::string_view::npos) return std::string(name);
  std::string out = "\"";
  for (const char c : name) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

Number parse_number(std::string_view field) {
  if (field.empty() || field == "NA") return {std::numeric_limits<double>::quiet_NaN(), nullptr};
  std::string_view digits = field;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return {0, "text"};
  if (error == std::errc::result_out_of_range) return {0, "a number beyond the range of double precision"};
  if (std::isinf(value)) return {0, "an infinity"};
  return {value, nullptr};
}

void append_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "nan";
    return;
  }
  char buffer[32];  // the longest shortest form of a double has 24 characters
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

double in_float_digits(double value) {
  if (!std::isfinite(value)) return value;
  char buffer[32];  // the longest shortest form of a float has 15 characters
  const char* end = std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value)).ptr;
  std::from_chars(buffer, end, value);
  return value;
}

}  // namespace gonio::tabulated
