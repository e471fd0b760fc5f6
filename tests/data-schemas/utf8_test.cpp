// SPDX-License-Identifier: BSD-3-Clause
// Replacement of ill-formed UTF-8.
#include "data-schemas/utf8.hpp"

#include "tests/check.hpp"

using gonio::valid_utf8;
using namespace std::string_literals;

TEST_CASE("well-formed text comes back unchanged", "[utf8]") {
  for (const std::string& text : {""s, "plain"s, "θᵢ ∫ 𝛉"s, "\u0080\u07ff\u0800\ud7ff\ue000\uffff\U00010000\U0010ffff"s, "a\0b"s})
    CHECK(valid_utf8(text) == text);
}

TEST_CASE("each byte of an ill-formed sequence is replaced", "[utf8]") {
  const std::string r = "\xEF\xBF\xBD";
  CHECK(valid_utf8("\x80") == r);                          // continuation without a lead
  CHECK(valid_utf8("\xc0\xaf") == r + r);                  // overlong
  CHECK(valid_utf8("\xe0\x80\xaf") == r + r + r);          // overlong
  CHECK(valid_utf8("\xed\xa0\x80") == r + r + r);          // surrogate
  CHECK(valid_utf8("\xf4\x90\x80\x80") == r + r + r + r);  // above U+10FFFF
  CHECK(valid_utf8("\xf8") == r);
  CHECK(valid_utf8("a\xe2\x88") == "a" + r + r);  // cut off
  CHECK(valid_utf8("\xe2z") == r + "z");
}
