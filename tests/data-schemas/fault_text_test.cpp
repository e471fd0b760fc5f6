// SPDX-License-Identifier: BSD-3-Clause
// The words of a fault.
#include "data-schemas/fault_text.hpp"

#include "tests/check.hpp"

using gonio::Json;

namespace {
std::string wanted(std::string_view schema) { return gonio::wanted_text(gonio::parse_json(schema, "schema")); }
}  // namespace

TEST_CASE("a found value is shown with its type, long text cut between characters", "[fault_text]") {
  CHECK(gonio::found_text(Json("fast")) == "\"fast\" (string)");
  CHECK(gonio::found_text(Json(400)) == "400 (integer)");
  CHECK(gonio::found_text(Json(0.5)) == "0.5 (number)");
  CHECK(gonio::found_text(Json()) == "null");
  CHECK(gonio::found_text(Json::array()) == "an array of 0 elements");
  CHECK(gonio::found_text(Json::object({{"a", 1}})) == "an object of 1 member");
  std::string thetas;
  for (int i = 0; i < 100; ++i) thetas += "θ";
  const std::string text = gonio::found_text(Json(thetas));
  CHECK(text.size() < 80);
  CHECK(text.ends_with("θ… (string)"));
}

TEST_CASE("a schema is told in words", "[fault_text]") {
  CHECK(wanted(R"({"type": "number", "minimum": 0, "maximum": 360})") == "a number from 0 to 360");
  CHECK(wanted(R"({"type": "number", "exclusiveMinimum": 0})") == "a number above 0");
  CHECK(wanted(R"({"type": "number", "exclusiveMinimum": 0, "maximum": 1})") == "a number above 0 and at most 1");
  CHECK(wanted(R"({"type": "number", "maximum": 1})") == "a number of at most 1");
  CHECK(wanted(R"({"minimum": 0.5, "exclusiveMaximum": 1})") == "a number of at least 0.5 and below 1");
  CHECK(wanted(R"({"type": "integer", "multipleOf": 2})") == "an integer a multiple of 2");
  CHECK(wanted(R"({"type": ["number", "null"], "minimum": 0})") == "a number of at least 0 or null");
  CHECK(wanted(R"({"type": "boolean"})") == "true or false");
  CHECK(wanted(R"({"type": "array", "minItems": 1, "uniqueItems": true})") == "an array of at least 1 element, all different");
  CHECK(wanted(R"({"type": "array", "minItems": 1, "maxItems": 4})") == "an array of 1 to 4 elements");
  CHECK(wanted(R"({"type": "array", "maxItems": 1})") == "an array of at most 1 element");
  CHECK(wanted(R"({"type": "string", "maxLength": 4})") == "a string of at most 4 characters");
  CHECK(wanted(R"({"const": "gonio"})") == "\"gonio\"");
  CHECK(wanted(R"({"enum": [3, 4]})") == "one of 3, 4");
  CHECK(wanted(R"({"enum": [3]})") == "3");
  CHECK(wanted(R"({"anyOf": [{"type": "null"}, {"type": "string"}, {"type": "null"}]})") == "null or a string");
  CHECK(wanted(R"({"required": ["a"]})") == "an object");
  CHECK(wanted(R"({"minLength": 2})") == "a string of at least 2 characters");
  CHECK(wanted(R"({"contains": {}})") == "an array");
  CHECK(wanted("{}") == "a value that the schema allows");
}

TEST_CASE("the distance between two words is that of Levenshtein", "[fault_text]") {
  CHECK(gonio::edit_distance("kitten", "sitting") == 3);
  CHECK(gonio::edit_distance("", "abc") == 3);
  CHECK(gonio::edit_distance("abc", "abc") == 0);
}

TEST_CASE("a near name is suggested and a far one is not", "[fault_text]") {
  const std::vector<std::string> known = {"theta_i_deg", "phi_i_deg"};
  CHECK(gonio::wanted_member_text("teta_i_deg", known) == "perhaps \"theta_i_deg\"; one of theta_i_deg, phi_i_deg");
  CHECK(gonio::wanted_member_text("wavelength", known) == "one of theta_i_deg, phi_i_deg");
  CHECK(gonio::wanted_member_text("x", {}) == "no members");
}
