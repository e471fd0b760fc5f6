// SPDX-License-Identifier: BSD-3-Clause
// The validator's yes and no.
#include "data-schemas/schema_validator.hpp"

#include "brdf/error.hpp"
#include "data-schemas/embedded.hpp"
#include "data-schemas/schema_reference.hpp"
#include "tests/check.hpp"

using gonio::Json;

namespace {
gonio::SchemaValidator validator(std::string_view schema) { return gonio::SchemaValidator(gonio::parse_json(schema, "schema")); }
}  // namespace

TEST_CASE("types are strict", "[schema_validator]") {
  const gonio::SchemaValidator number = validator(R"({"type": "number"})"), integer = validator(R"({"type": "integer"})");
  CHECK(number.accepts(1));
  CHECK(number.accepts(1.5));
  CHECK_FALSE(number.accepts("1"));
  CHECK_FALSE(number.accepts(true));
  CHECK_FALSE(number.accepts(nullptr));
  CHECK(integer.accepts(2.0));
  CHECK_FALSE(integer.accepts(2.5));
  CHECK_FALSE(integer.accepts("2"));
}

TEST_CASE("what is no schema is an internal error", "[schema_validator]") {
  CHECK_THROWS_AS(validator(R"({"type": "nmber"})"), gonio::Error);
  CHECK_THROWS_AS(validator(R"({"minLength": -1})"), gonio::Error);
}

TEST_CASE("every schema of the list is built in and can be used", "[schema_validator]") {
  for (const gonio::Schema schema : gonio::every_schema) {
    const std::string file = std::string(name(schema)) + ".schema.json";
    INFO(file);
    REQUIRE_FALSE(gonio::schema_file_text(file).empty());
    CHECK_FALSE(gonio::SchemaValidator(gonio::expanded_schema(file)).accepts(Json()));
    CHECK(gonio::parse_json(gonio::schema_text(schema), file).at("$id").string() == file);
  }
}
