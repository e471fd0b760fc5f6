// SPDX-License-Identifier: BSD-3-Clause
// The JSON value: access, order, printing.
#include "data-schemas/json.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "brdf/error.hpp"
#include "tests/check.hpp"

using gonio::Json;

TEST_CASE("members keep the order in which they were set", "[json]") {
  Json value;
  value.set("zulu", 1).set("alpha", 2.5).set("mike", "x").set("zulu", 3);
  CHECK(value.dump(-1) == R"({"zulu":3,"alpha":2.5,"mike":"x"})");
  CHECK(value.size() == 3);
  CHECK(value.at("zulu").integer() == 3);
  CHECK(value.contains("alpha"));
  CHECK_FALSE(value.contains("bravo"));
}

TEST_CASE("NaN and the infinities become null", "[json]") {
  CHECK(Json(std::nan("")).is_null());
  CHECK(Json(std::numeric_limits<double>::infinity()).is_null());
  CHECK(Json(-std::numeric_limits<double>::infinity()).dump() == "null");
}

TEST_CASE("numbers print in their shortest form, and a double always looks like one", "[json]") {
  CHECK(Json(1).dump() == "1");
  CHECK(Json(1.0).dump() == "1.0");
  CHECK(Json(-0.0).dump() == "-0.0");
  CHECK(Json(0.1).dump() == "0.1");
  CHECK(Json(1e300).dump() == "1e+300");
  CHECK(Json(std::numeric_limits<std::int64_t>::min()).dump() == "-9223372036854775808");
  CHECK(Json(std::uint64_t{9223372036854775807u}).is_integer());
  CHECK_FALSE(Json(std::uint64_t{9223372036854775808u}).is_integer());
}

TEST_CASE("every finite double reads back to the same bits", "[json]") {
  constexpr unsigned seed = 7;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const Json back = gonio::parse_json(Json(value).dump(), "text");
    if (!back.is_integer() && std::bit_cast<std::uint64_t>(back.number()) == std::bit_cast<std::uint64_t>(value)) continue;
    FAIL("printed as " << Json(value).dump());
  }
  SUCCEED("all the same");
}

TEST_CASE("strings are escaped and bytes that are no UTF-8 are replaced", "[json]") {
  CHECK(Json("a\"b\\c\n\t\r\x01\x7f").dump() == R"("a\"b\\c\n\t\r\u0001\u007f")");
  CHECK(Json("θ 1/sr").dump() == "\"θ 1/sr\"");
  CHECK(Json("a\xffz").dump() == "\"a\xEF\xBF\xBDz\"");
  const std::string text = Json(std::string("\xed\xa0\x80 \xc0\xaf")).dump();
  CHECK_NOTHROW(gonio::parse_json(text, "text"));
}

TEST_CASE("arrays of plain values stay on one line, other values are indented", "[json]") {
  const Json value = Json::object({{"interval", Json(Json::Array{0.5, nullptr})},
                                   {"list", Json(Json::Array{Json::object({{"a", 1}})})},
                                   {"none", Json::object()},
                                   {"empty", Json::array()}});
  CHECK(value.dump() == R"({
  "interval": [0.5, null],
  "list": [
    {
      "a": 1
    }
  ],
  "none": {},
  "empty": []
})");
  CHECK(gonio::parse_json(value.dump(), "text") == value);
  CHECK(gonio::parse_json(value.dump(-1), "text") == value);
}

TEST_CASE("what is not there or is of another type is an internal error", "[json]") {
  const Json value = Json::object({{"a", "text"}, {"n", 4.0}, {"h", 0.5}, {"l", Json(Json::Array{1})}});
  const auto refused = [](auto&& read) {
    try {
      read();
    } catch (const gonio::Error& error) {
      return error.kind() == gonio::ErrorKind::internal;
    }
    return false;
  };
  CHECK(refused([&] { (void)value.at("b"); }));
  CHECK(refused([&] { (void)value.at("a").number(); }));
  CHECK(refused([&] { (void)value.at("a").boolean(); }));
  CHECK(refused([&] { (void)value.at("h").integer(); }));
  CHECK(refused([&] { (void)value.at("l")[1]; }));
  CHECK(refused([&] { (void)value[0]; }));
  CHECK(refused([&] { Json(1).set("a", 1); }));
  CHECK(refused([&] { Json("x").push_back(1); }));
  CHECK(value.at("n").integer() == 4);
  CHECK(value.get("b").is_null());
  CHECK(value.number_or("b", 2.0) == 2.0);
  CHECK(value.number_or("h", 2.0) == 0.5);
  CHECK(value.string_or("a", "other") == "text");
  CHECK(value.boolean_or("b", true));
}
