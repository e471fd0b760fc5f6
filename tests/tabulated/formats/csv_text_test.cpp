// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_text.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/check.hpp"

using namespace gonio::tabulated;

namespace {

std::vector<std::string> pieces(std::string_view line) {
  std::vector<std::string_view> fields;
  split(line, separator_of(line), fields);
  return {fields.begin(), fields.end()};
}

using Fields = std::vector<std::string>;

}  // namespace

TEST_CASE("Space, tab, comma and semicolon separate") {
  CHECK(pieces("1 2  3") == Fields{"1", "2", "3"});
  CHECK(pieces("  1   2 3  ") == Fields{"1", "2", "3"});
  CHECK(pieces("1\t2\t3") == Fields{"1", "2", "3"});
  CHECK(pieces("1,2,3") == Fields{"1", "2", "3"});
  CHECK(pieces("1, 2 ,\t3") == Fields{"1", "2", "3"});
  CHECK(pieces("1;2;3") == Fields{"1", "2", "3"});
  CHECK(pieces("1,5;2,5") == Fields{"1,5", "2,5"});
}

TEST_CASE("Empty fields count between separators that are letters") {
  CHECK(pieces("1,,3") == Fields{"1", "", "3"});
  CHECK(pieces("1\t\t3") == Fields{"1", "", "3"});
  CHECK(pieces(",2,") == Fields{"", "2", ""});
  CHECK(pieces("") == Fields{});
  CHECK(pieces("  \t ") == Fields{});
}

TEST_CASE("A number sign starts a comment, except in quotes") {
  CHECK(pieces("# 1,2") == Fields{});
  CHECK(pieces("1,2 # three, four") == Fields{"1", "2"});
  CHECK(pieces("1 2 # three; four") == Fields{"1", "2"});
  CHECK(pieces("\"a # b\",2") == Fields{"a # b", "2"});
  CHECK(pieces("\"a,b\";2") == Fields{"a,b", "2"});
  CHECK(pieces("\"never closed,2") == Fields{"\"never closed,2"});
}

TEST_CASE("A name survives being written as a field") {
  for (const std::string name : {"value", "a b", "a,b", "a;b", "a\"b", "#1", "\"", "f.550nm", " x "}) {
    const std::string row = as_field(name) + ",2";
    std::vector<std::string_view> fields;
    split(row, ',', fields);
    REQUIRE(fields.size() == 2);
    CHECK(unquoted(fields[0]) == name);
  }
}

TEST_CASE("Lines end with LF or CR LF or the end of the file, and a byte order mark is no part of them") {
  CsvLines lines("\xEF\xBB\xBFone\r\ntwo\n\nfour");
  CHECK(lines.next() == "one");
  CHECK(lines.next() == "two");
  CHECK(lines.next() == "");
  CHECK(lines.next() == "four");
  CHECK(lines.number() == 4);
  CHECK_FALSE(lines.next().has_value());
}

TEST_CASE("Numbers are finite or unknown; everything else has a name") {
  CHECK(parse_number("1.5").value == 1.5);
  CHECK(parse_number("+1.5").value == 1.5);
  CHECK(parse_number("-1e-3").value == -1e-3);
  for (const char* text : {"", "nan", "NaN", "NAN", "NA"}) {
    CHECK(parse_number(text).fault == nullptr);
    CHECK(std::isnan(parse_number(text).value));
  }
  for (const char* text : {"x", "1.5x", "1,5", "--1", "+-1", "0x10", "1e", "1 2", "N/A", "1.0D-3"})
    CHECK(parse_number(text).fault == std::string("text"));
  for (const char* text : {"inf", "-inf", "Infinity", "+inf"}) CHECK(parse_number(text).fault == std::string("an infinity"));
  CHECK(parse_number("1e400").fault != nullptr);
  CHECK(parse_number(std::string_view("1\0", 2)).fault != nullptr);
}

TEST_CASE("Numbers read back to the same bits") {
  std::mt19937_64 random(20260701);
  for (int k = 0; k < 100000; ++k) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    const Number number = parse_number(text);
    REQUIRE(number.fault == nullptr);
    REQUIRE(std::memcmp(&number.value, &value, sizeof value) == 0);
  }
}
