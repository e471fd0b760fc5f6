// SPDX-License-Identifier: BSD-3-Clause
// References between schemas.
#include "data-schemas/schema_reference.hpp"

#include "brdf/error.hpp"
#include "data-schemas/embedded.hpp"
#include "tests/check.hpp"

namespace {

bool is_refused(std::string_view schema) {
  try {
    gonio::expanded_schema_text(schema, "s");
  } catch (const gonio::Error& error) {
    return error.kind() == gonio::ErrorKind::internal;
  }
  return false;
}

}  // namespace

TEST_CASE("a reference is replaced by its target, within a schema and between schemas", "[schema_reference]") {
  const gonio::Json schema = gonio::expanded_schema_text(R"({"properties": {"a": {"$ref": "#/definitions/x", "description": "d"}},
    "definitions": {"x": {"items": {"$ref": "#/definitions/y"}}, "y": {"type": "null"}}})",
                                                         "s");
  CHECK(schema.dump(-1) == R"({"properties":{"a":{"items":{"type":"null"}}}})");
  const gonio::Json fit = gonio::expanded_schema("fit.schema.json");
  CHECK(fit.at("properties").at("context").at("properties").at("program").at("const").string() == "gonio");
  CHECK(fit.dump().find("$ref") == std::string::npos);
}

TEST_CASE("a reference to nothing and a circle are refused", "[schema_reference]") {
  CHECK(is_refused(R"({"$ref": "#/definitions/none"})"));
  CHECK(is_refused(R"({"$ref": "none.schema.json"})"));
  CHECK(is_refused(R"({"$ref": "https://example.org/none.schema.json"})"));
  CHECK(is_refused(R"({"$ref": "#"})"));
  CHECK(is_refused(R"({"definitions": {"x": {"items": {"$ref": "#/definitions/x"}}}, "items": {"$ref": "#/definitions/x"}})"));
}
