// SPDX-License-Identifier: BSD-3-Clause
// Text -> Json: what is read, and where the faults are.
#include <random>

#include "brdf/error.hpp"
#include "data-schemas/json.hpp"
#include "tests/check.hpp"

using gonio::Json;

namespace {

std::vector<gonio::Fault> faults(std::string_view text) {
  try {
    gonio::parse_json(text, "doc");
  } catch (const gonio::Error& error) {
    CHECK(error.kind() == gonio::ErrorKind::input);
    return error.faults();
  }
  return {};
}

std::string only(std::string_view text) {
  const std::vector<gonio::Fault> all = faults(text);
  REQUIRE(all.size() == 1);
  return all[0].where + " | " + all[0].found + " | " + all[0].wanted;
}

}  // namespace

TEST_CASE("values of every type are read", "[parse_json]") {
  const Json value =
      gonio::parse_json(R"({"n": null, "t": true, "i": -3, "d": 1.5e-3, "s": "a\u00e9", "a": [1, [], {}], "o": {"k": 2.0}})", "doc");
  CHECK(value.at("n").is_null());
  CHECK(value.at("t").boolean());
  CHECK(value.at("i").integer() == -3);
  CHECK(value.at("d").number() == 1.5e-3);
  CHECK(value.at("s").string() == "aé");
  CHECK(value.at("a").size() == 3);
  CHECK(value.at("o").at("k").number() == 2.0);
  CHECK(value.members()[6].first == "o");
  CHECK(gonio::parse_json(" 18446744073709551615 ", "doc").number() == 18446744073709551615.0);
}

TEST_CASE("an error of syntax is named by line and column", "[parse_json]") {
  CHECK(only("{\n  \"a\": 1,\n}") == "doc:3:1 | '}' | string literal");
  CHECK(only("[1,\n 2 3]") == "doc:2:4 | number literal | ']'");
  CHECK(only("{\"a\": tru}") == "doc:1:7 | \"tru}\" | JSON text");
  CHECK(only("") == "doc:1:1 | end of input | '[', '{', or a literal");
  CHECK(only("{\"é\": }") == "doc:1:7 | '}' | '[', '{', or a literal");
  CHECK(only("{} x") == "doc:1:4 | \"x\" | end of input");
  CHECK(only("[1e999]") == "doc:1:6 | \"1e999\" | a number that a double can hold");
  CHECK(only(std::string_view("{}\0x", 4)) == "doc:1:3 | a zero byte | JSON text");
}

TEST_CASE("what JSON does not have is refused", "[parse_json]") {
  for (const char* text :
       {"[NaN]", "[Infinity]", "[01]", "[.5]", "[1.]", "[+1]", "['a']", "// c\n1", "[1,]", "\"\xff\"", "\"a\nb\"", "{1:2}"}) {
    INFO(text);
    CHECK(faults(text).size() == 1);
  }
}

TEST_CASE("every key that stands twice is a fault", "[parse_json]") {
  const std::vector<gonio::Fault> all = faults("{\"a\": 1, \"b\": {\"c\": 1,\n \"c\": 2}, \"a\": 3, \"d\": {\"a\": 1}}");
  REQUIRE(all.size() == 2);
  CHECK(all[0].where.starts_with("doc:2:"));
  CHECK(all[0].found == "a second \"c\" in the same object");
  CHECK(all[1].found == "a second \"a\" in the same object");
}

TEST_CASE("nesting is read up to its limit and refused beyond it", "[parse_json]") {
  const auto nested = [](int depth) {
    const auto n = static_cast<std::size_t>(depth);
    return std::string(n, '[') + std::string(n, ']');
  };
  CHECK(faults(nested(gonio::deepest_json)).empty());
  CHECK(only(nested(gonio::deepest_json + 1)) == "doc:1:201 | arrays and objects nested deeper than that | at most 200 levels");
  CHECK(faults(std::string(10'000'000, '[')).size() == 1);
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  CHECK(faults(objects).size() == 1);
}
