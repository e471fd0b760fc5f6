// SPDX-License-Identifier: BSD-3-Clause
// The letters of a CSV file: lines, fields and numbers, independent of the locale.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::tabulated {

/// Separator meaning "any run of spaces and tabs".
constexpr char blanks = ' ';

/// Walks through the lines of a text. Ends of line are LF or CR LF, the last one may be missing; a UTF-8 byte order mark is skipped.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text);
  /// The next line without its end, or nothing.
  std::optional<std::string_view> next();
  /// Number of the line `next` gave last, from 1.
  std::size_t number() const noexcept { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Nothing but blanks or a comment.
bool is_empty_line(std::string_view line);

/// The separator of a file, seen from its first row: the first of ';', ',' and tab that occurs outside quotes, else blanks.
char separator_of(std::string_view row);

/// Cuts a line into trimmed fields, up to a `#` outside quotes. A field in double quotes may hold separators; a doubled quote inside
/// stands for one and is left doubled. With a separator other than blanks, empty fields count.
void split(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// A field that is text: doubled quotes made single.
std::string unquoted(std::string_view field);
/// The opposite: quoted where the name holds something that would end the field.
std::string as_field(std::string_view name);

struct Number {
  double value = 0;             ///< NaN for an empty field, `nan` and `NA`
  const char* fault = nullptr;  ///< what it is instead of a number, or null
};
Number parse_number(std::string_view field);

/// Appends the shortest text that reads back to the same double; `nan` for NaN.
void append_number(std::string& out, double value);

/// The number with the fewest decimal digits that single precision cannot tell from `value`: what to store where a text shall be short.
double in_float_digits(double value);

}  // namespace gonio::tabulated
