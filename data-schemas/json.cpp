// SPDX-License-Identifier: BSD-3-Clause
// Access to and printing of a JSON value.
#include "data-schemas/json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "brdf/error.hpp"
#include "data-schemas/utf8.hpp"

namespace gonio {
namespace {

const Json null_value;

[[noreturn]] void refuse(const char* found, const std::string& wanted) { throw Error(ErrorKind::internal, {"JSON value", found, wanted}); }

void append_number(std::string& out, double number) {
  char buffer[32];  // the longest shortest form of a double has 24 characters
  const char* end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  const std::string_view text(buffer, static_cast<std::size_t>(end - buffer));
  out += text;
  if (text.find_first_of(".e") == text.npos) out += ".0";  // stays a number that is no integer when it is read again
}

void append_string(std::string& out, std::string_view text) {
  constexpr char hex[] = "0123456789abcdef";
  out += '"';
  for (const char character : valid_utf8(text)) {
    switch (character) {
      case '"': out += "\\\""; break;
      case '\\': out += "\\\\"; break;
      case '\n': out += "\\n"; break;
      case '\r': out += "\\r"; break;
      case '\t': out += "\\t"; break;
      default:
        if (const auto code = static_cast<unsigned char>(character); code < 0x20 || code == 0x7f) {
          out += "\\u00";
          out += hex[code >> 4];
          out += hex[code & 15];
        } else {
          out += character;
        }
    }
  }
  out += '"';
}

/// Arrays that hold no array and no object stay on one line: a pair of bounds is one thing to read.
bool is_flat(const Json::Array& elements) {
  return std::none_of(elements.begin(), elements.end(), [](const Json& element) { return element.is_array() || element.is_object(); });
}

void append(std::string& out, const Json& value, int indent, int depth) {
  const auto new_line = [&](int level) {
    if (indent >= 0) (out += '\n').append(static_cast<std::size_t>(indent * level), ' ');
  };
  if (value.is_null()) {
    out += "null";
  } else if (value.is_bool()) {
    out += value.boolean() ? "true" : "false";
  } else if (value.is_integer()) {
    out += std::to_string(value.integer());
  } else if (value.is_number()) {
    append_number(out, value.number());
  } else if (value.is_string()) {
    append_string(out, value.string());
  } else if (value.is_array()) {
    const Json::Array& elements = value.elements();
    const bool flat = is_flat(elements);
    out += '[';
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (i > 0) out += flat && indent >= 0 ? ", " : ",";
      if (!flat) new_line(depth + 1);
      append(out, elements[i], indent, depth + 1);
    }
    if (!flat) new_line(depth);
    out += ']';
  } else {
    const Json::Members& members = value.members();
    out += '{';
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) out += ',';
      new_line(depth + 1);
      append_string(out, members[i].first);
      out += indent >= 0 ? ": " : ":";
      append(out, members[i].second, indent, depth + 1);
    }
    if (!members.empty()) new_line(depth);
    out += '}';
  }
}

}  // namespace

Json::Json() = default;
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

bool operator==(const Json& a, const Json& b) { return a.value_ == b.value_; }

Json::Json(std::uint64_t value) {
  if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    value_ = static_cast<std::int64_t>(value);
  else
    value_ = static_cast<double>(value);
}

Json::Json(double value) {
  if (std::isfinite(value)) value_ = value;
}

const char* Json::type_name() const noexcept {
  constexpr const char* names[] = {"null", "boolean", "integer", "number", "string", "array", "object"};
  return value_.valueless_by_exception() ? "null" : names[value_.index()];
}

bool Json::boolean() const {
  if (const bool* value = std::get_if<bool>(&value_)) return *value;
  refuse(type_name(), "boolean");
}

std::int64_t Json::integer() const {
  constexpr double limit = 9007199254740992.0;  // 2^53: beyond it not every integer is a double
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return *value;
  if (const auto* value = std::get_if<double>(&value_); value && std::abs(*value) <= limit && std::trunc(*value) == *value)
    return static_cast<std::int64_t>(*value);
  refuse(type_name(), "integer");
}

double Json::number() const {
  if (const auto* value = std::get_if<double>(&value_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*value);
  refuse(type_name(), "number");
}

const std::string& Json::string() const {
  if (const auto* value = std::get_if<std::string>(&value_)) return *value;
  refuse(type_name(), "string");
}

const Json::Array& Json::elements() const {
  if (const auto* value = std::get_if<Array>(&value_)) return *value;
  refuse(type_name(), "array");
}

const Json::Members& Json::members() const {
  if (const auto* value = std::get_if<Members>(&value_)) return *value;
  refuse(type_name(), "object");
}

std::size_t Json::size() const {
  if (is_array()) return elements().size();
  if (is_object()) return members().size();
  return 0;
}

const Json& Json::operator[](std::size_t index) const {
  const Array& array = elements();
  if (index >= array.size()) refuse("array that is too short", "element " + std::to_string(index));
  return array[index];
}

bool Json::contains(std::string_view key) const {
  const auto* members = std::get_if<Members>(&value_);
  return members && std::any_of(members->begin(), members->end(), [&](const auto& member) { return member.first == key; });
}

const Json& Json::at(std::string_view key) const {
  for (const auto& [name, value] : members())
    if (name == key) return value;
  refuse("object without it", "member \"" + std::string(key) + '"');
}

const Json& Json::get(std::string_view key) const {
  if (const auto* members = std::get_if<Members>(&value_))
    for (const auto& [name, value] : *members)
      if (name == key) return value;
  return null_value;
}

double Json::number_or(std::string_view key, double otherwise) const {
  const Json& value = get(key);
  return value.is_null() ? otherwise : value.number();
}

std::string Json::string_or(std::string_view key, std::string otherwise) const {
  const Json& value = get(key);
  return value.is_null() ? std::move(otherwise) : value.string();
}

bool Json::boolean_or(std::string_view key, bool otherwise) const {
  const Json& value = get(key);
  return value.is_null() ? otherwise : value.boolean();
}

Json& Json::set(std::string key, Json value) {
  if (is_null()) value_ = Members{};
  auto* members = std::get_if<Members>(&value_);
  if (!members) refuse(type_name(), "object");
  const auto found = std::find_if(members->begin(), members->end(), [&](const auto& member) { return member.first == key; });
  if (found != members->end())
    found->second = std::move(value);
  else
    members->emplace_back(std::move(key), std::move(value));
  return *this;
}

Json& Json::push_back(Json value) {
  if (is_null()) value_ = Array{};
  auto* elements = std::get_if<Array>(&value_);
  if (!elements) refuse(type_name(), "array");
  elements->push_back(std::move(value));
  return *this;
}

std::string Json::dump(int indent) const {
  std::string out;
  append(out, *this, indent, 0);
  return out;
}

}  // namespace gonio
