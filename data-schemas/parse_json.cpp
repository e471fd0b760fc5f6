// SPDX-License-Identifier: BSD-3-Clause
// Text -> Json, with the place of every fault.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "brdf/error.hpp"
#include "data-schemas/json.hpp"
#include "data-schemas/utf8.hpp"

namespace gonio {
namespace {

/// Walks over the text and tells how far the parser has read: its events carry no position.
class TrackedPosition {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TrackedPosition(const char* at, const char** reached) : at_(at), reached_(reached) {}
  const char& operator*() const { return *at_; }
  TrackedPosition& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  bool operator==(const TrackedPosition& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

constexpr std::size_t longest_quote = 40;  ///< characters of the text shown in a message

std::string in_quotes(std::string_view text) {
  if (text.size() <= longest_quote) return '"' + valid_utf8(text) + '"';
  return '"' + valid_utf8(text.substr(0, longest_quote)) + "…\"";
}

/// Receives the events of the parser and builds the value.
class Builder {
 public:
  Builder(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  const char** reached() { return &reached_; }
  std::vector<Fault>& faults() { return faults_; }
  Json& value() { return root_; }

  bool null() { return add(Json()); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(Json(std::move(value))); }
  bool binary(std::vector<std::uint8_t>&) { return false; }  // no event of JSON text

  bool start_object(std::size_t) { return open(Json::Members{}); }
  bool start_array(std::size_t) { return open(Json::Array{}); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Level& level = levels_.back();
    for (const auto& [other, value] : level.members)
      if (other == name) fault(reached_ - 1, "a second " + in_quotes(name) + " in the same object", "every key once");
    level.members.emplace_back(std::move(name), Json());
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last_token, const nlohmann::json::exception& error) {
    const std::string_view what = error.what();
    const char* at = text_.data() + std::min(position, text_.size() + 1) - (position > 0 ? 1 : 0);
    if (what.find("number overflow") != what.npos) {
      fault(at, in_quotes(last_token), "a number that a double can hold");
      return false;
    }
    // The exception reads "... while parsing X - PROBLEM; last read: 'TOKEN'; expected WANTED", the last two where they apply.
    constexpr std::string_view before_problem = " - ", before_token = "; last read: ", before_wanted = "; expected ";
    const std::size_t problem = std::min(what.find(before_problem), what.size() - before_problem.size()) + before_problem.size();
    const std::size_t token = what.find(before_token, problem), wanted = what.rfind(before_wanted);
    const bool says_wanted = wanted != what.npos && wanted >= problem;
    std::string found(what.substr(problem, std::min({token, says_wanted ? wanted : what.size(), what.size()}) - problem));
    constexpr std::string_view unexpected = "unexpected ";
    if (found.starts_with(unexpected)) {
      found.erase(0, unexpected.size());
      if (found.find("literal") != found.npos && last_token.size() <= position) at = text_.data() + position - last_token.size();
    } else if (found == "invalid literal") {  // its token starts too early: show the word that ends here
      const std::string_view before = text_.substr(0, static_cast<std::size_t>(at - text_.data()));
      const char* word = text_.data() + (before.find_last_of(" \t\r\n,:[]{}\"") + 1);
      found = in_quotes({word, std::min(at + 1, text_.data() + text_.size())});
      at = word;
    } else if (!last_token.empty()) {
      found += " in " + in_quotes(last_token);
    }
    fault(at, found, says_wanted ? std::string(what.substr(wanted + before_wanted.size())) : "JSON text");
    return false;
  }

  /// A fault at a place of the text: lines and columns count from 1, columns in characters.
  void fault(const char* at, std::string found, std::string wanted) {
    const std::string_view before = text_.substr(0, static_cast<std::size_t>(at - text_.data()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::string_view last = before.substr(before.rfind('\n') + 1);
    const auto column = std::count_if(last.begin(), last.end(), [](char c) { return (c & 0xC0) != 0x80; }) + 1;
    faults_.push_back({where_ + ':' + std::to_string(line) + ':' + std::to_string(column), std::move(found), std::move(wanted)});
  }

 private:
  /// An array or object that is still being read.
  struct Level {
    bool is_object = false;
    Json::Array elements;
    Json::Members members;
  };

  bool add(Json value) {
    if (levels_.empty())
      root_ = std::move(value);
    else if (levels_.back().is_object)
      levels_.back().members.back().second = std::move(value);
    else
      levels_.back().elements.push_back(std::move(value));
    return true;
  }

  template <class Container>
  bool open(Container) {
    if (levels_.size() >= static_cast<std::size_t>(deepest_json)) {
      fault(reached_ - 1, "arrays and objects nested deeper than that", "at most " + std::to_string(deepest_json) + " levels");
      return false;
    }
    levels_.push_back({std::is_same_v<Container, Json::Members>, {}, {}});
    return true;
  }

  bool close() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    return level.is_object ? add(Json(std::move(level.members))) : add(Json(std::move(level.elements)));
  }

  std::string_view text_;
  const std::string& where_;
  const char* reached_ = text_.data();
  std::vector<Level> levels_;
  std::vector<Fault> faults_;
  Json root_;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& where) {
  Builder builder(text, where);
  // The parser takes a zero byte for the end of the text and would not see what follows it.
  if (const std::size_t zero = text.find('\0'); zero != text.npos) {
    builder.fault(text.data() + zero, "a zero byte", "JSON text");
  } else {
    const char* end = text.data() + text.size();
    nlohmann::json::sax_parse(TrackedPosition(text.data(), builder.reached()), TrackedPosition(end, builder.reached()), &builder);
  }
  if (!builder.faults().empty()) throw Error(ErrorKind::input, where + " is no JSON that can be read", std::move(builder.faults()));
  return std::move(builder.value());
}

}  // namespace gonio
