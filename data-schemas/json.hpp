// SPDX-License-Identifier: BSD-3-Clause
// A JSON value as plain data. The rest of gonio sees JSON only through this header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gonio {

/// A JSON value: null, boolean, integer, number, string, array or object (members keep their order).
/// Reading a member or a type that is not there throws Error(internal): documents are validated before they are read.
class Json {
 public:
  using Array = std::vector<Json>;
  using Members = std::vector<std::pair<std::string, Json>>;

  Json();  ///< null
  Json(const Json&);
  Json(Json&&) noexcept;
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;
  ~Json();

  Json(std::nullptr_t) : Json() {}
  Json(bool value) : value_(value) {}
  Json(int value) : value_(static_cast<std::int64_t>(value)) {}
  Json(std::int64_t value) : value_(value) {}
  Json(std::uint64_t value);  ///< as a double where it does not fit an int64
  /// NaN and the infinities become null: JSON has no such numbers.
  Json(double value);
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(Array value) : value_(std::move(value)) {}
  Json(Members value) : value_(std::move(value)) {}
  static Json array() { return Json(Array{}); }
  static Json object() { return Json(Members{}); }
  static Json object(std::initializer_list<std::pair<std::string, Json>> members) { return Json(Members(members.begin(), members.end())); }

  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  bool is_bool() const { return std::holds_alternative<bool>(value_); }
  bool is_integer() const { return std::holds_alternative<std::int64_t>(value_); }
  bool is_number() const { return is_integer() || std::holds_alternative<double>(value_); }
  bool is_string() const { return std::holds_alternative<std::string>(value_); }
  bool is_array() const { return std::holds_alternative<Array>(value_); }
  bool is_object() const { return std::holds_alternative<Members>(value_); }

  /// `null`, `boolean`, `integer`, `number`, `string`, `array` or `object`.
  const char* type_name() const noexcept;

  bool boolean() const;
  std::int64_t integer() const;  ///< also a number without a fraction, such as 4.0
  double number() const;         ///< integers too
  const std::string& string() const;
  const Array& elements() const;
  const Members& members() const;

  /// Number of elements or members; 0 for anything else.
  std::size_t size() const;
  const Json& operator[](std::size_t index) const;
  bool contains(std::string_view key) const;
  const Json& at(std::string_view key) const;
  /// The member, or null if there is none.
  const Json& get(std::string_view key) const;
  double number_or(std::string_view key, double otherwise) const;
  std::string string_or(std::string_view key, std::string otherwise) const;
  bool boolean_or(std::string_view key, bool otherwise) const;

  /// Sets or replaces a member (null becomes an object first).
  Json& set(std::string key, Json value);
  /// Appends an element (null becomes an array first).
  Json& push_back(Json value);

  /// Text; numbers in their shortest form that reads back to the same bits, and a double always shows that it is one (`1.0`).
  /// Bytes that are no UTF-8 become U+FFFD. indent < 0: one line without spaces; otherwise arrays of plain values stay on one line.
  std::string dump(int indent = 2) const;

  friend bool operator==(const Json& a, const Json& b);

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Members> value_;
};

/// Deepest nesting of arrays and objects that is read.
constexpr int deepest_json = 200;

/// Parses one JSON value (RFC 8259, UTF-8, no comments). Error(input), every fault as `where:line:column`, both counted from 1, columns
/// in characters: the first error of syntax, and every key that stands twice in one object. Numbers beyond the range of a double are
/// faults. Nesting deeper than `deepest_json` is a fault, so no input can exhaust the stack.
Json parse_json(std::string_view text, const std::string& where);

}  // namespace gonio
