// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/scattering_text.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

char ScatteringText::peek() noexcept {
  while (offset_ < text_.size() && is_blank(text_[offset_])) ++offset_;
  return offset_ < text_.size() ? text_[offset_] : '\0';
}

bool ScatteringText::take(char wanted) noexcept {
  if (peek() != wanted) return false;
  ++offset_;
  return true;
}

std::string ScatteringText::found() const {
  std::size_t end = offset_;
  while (end < text_.size() && end < offset_ + 60 && !is_blank(text_[end]) && text_[end] != ',') ++end;
  if (end == offset_) return offset_ < text_.size() ? excerpt(text_.substr(offset_, 1)) : "the end of the data";
  return excerpt(text_.substr(offset_, end - offset_));
}

std::optional<double> ScatteringText::number() {
  peek();
  const char* first = text_.data() + offset_;
  const char* const last = text_.data() + text_.size();
  if (first != last && *first == '+') ++first;
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  const bool ends = end == last || is_blank(*end) || *end == ',' || *end == '}';
  if (error != std::errc() || !ends || !std::isfinite(value)) {
    fault_ = {offset_, found(), error == std::errc::result_out_of_range ? "a number a double can hold" : "a finite number"};
    return std::nullopt;
  }
  offset_ = static_cast<std::size_t>(end - text_.data());
  take(',');
  return value;
}

}  // namespace gonio::tabulated
