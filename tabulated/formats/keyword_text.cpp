// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/keyword_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabulated/formats/csv_text.hpp"

namespace gonio::tabulated {
namespace {

constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_word_letter(char c) { return (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }

}  // namespace

KeywordText::KeywordText(std::string_view text, FaultList& faults, std::size_t first_line)
    : text_(text), line_(first_line), faults_(faults) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  advance();
}

void KeywordText::advance() {
  while (!text_.empty()) {
    const char c = text_.front();
    if (c == '\n') {
      ++line_;
      line_begins_ = true;
      text_.remove_prefix(1);
    } else if (is_space(c)) {
      text_.remove_prefix(1);
    } else if (c == '#' && line_begins_) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view comment = text_.substr(1, end - 1);
      if (comment.ends_with('\r')) comment.remove_suffix(1);
      comments_.emplace_back(comment);
      text_.remove_prefix(end);
    } else {
      break;
    }
  }
  const auto end = static_cast<std::size_t>(std::find_if(text_.begin(), text_.end(), is_space) - text_.begin());
  word_ = {text_.substr(0, end), line_};
  text_.remove_prefix(end);
  line_begins_ = false;
}

KeywordText::Word KeywordText::next() {
  const Word word = word_;
  advance();
  return word;
}

bool KeywordText::take(std::string_view keyword) {
  if (!same_word(word_.text, keyword)) return false;
  advance();
  return true;
}

std::optional<double> KeywordText::number(std::string_view what) {
  const Word word = next();
  const Number number = parse_number(word.text);
  if (!word.text.empty() && number.fault == nullptr && !std::isnan(number.value)) return number.value;
  faults_.add_at(word.line, word.text.empty() ? "the end of the file" : excerpt(word.text), fmt::format("a finite number: {}", what));
  return std::nullopt;
}

std::size_t KeywordText::count(std::string_view what) {
  const std::size_t line = word_.line;
  const std::optional<double> read = number(fmt::format("how many {}", what));
  if (!read) return 0;
  constexpr double most = 1e9;
  if (*read >= 1 && *read < most && *read == std::floor(*read) && can_hold(static_cast<std::size_t>(*read)))
    return static_cast<std::size_t>(*read);
  faults_.add_at(line, fmt::format("{} {}", *read, what), "a number that the file can hold");
  return 0;
}

std::vector<double> KeywordText::counted_list(std::string_view what) { return list(count(what), what); }

std::vector<double> KeywordText::list(std::size_t length, std::string_view what) {
  std::vector<double> out;
  for (std::size_t n = length; n > 0; --n) {
    const std::optional<double> value = number(what);
    if (!value) return {};
    out.push_back(*value);
  }
  return out;
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

bool has_keyword_line(std::string_view text, std::string_view keyword) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.size() >= keyword.size() && same_word(line.substr(0, keyword.size()), keyword) &&
        (line.size() == keyword.size() || !is_word_letter(line[keyword.size()])))
      return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

void require_angles(const std::vector<double>& angles, std::string_view what, double low, double high, FaultList& faults) {
  for (std::size_t k = 0; k < angles.size(); ++k) {
    if (angles[k] < low || angles[k] > high)
      faults.add(faults.file(), fmt::format("{} {}", what, angles[k]), fmt::format("{} to {} degrees", low, high));
    if (k > 0 && !(angles[k] > angles[k - 1]))
      faults.add(faults.file(), fmt::format("{} {} after {}", what, angles[k], angles[k - 1]), "increasing angles");
  }
}

}  // namespace gonio::tabulated
