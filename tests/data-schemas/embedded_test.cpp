// SPDX-License-Identifier: BSD-3-Clause
// The built-in texts are the files of data-schemas/.
#include "data-schemas/embedded.hpp"

#include <algorithm>
#include <filesystem>

#include "data-schemas/document.hpp"
#include "tests/check.hpp"

namespace fs = std::filesystem;

namespace {
const fs::path folder = fs::path(GONIO_SOURCE_DIR) / "data-schemas";
}

TEST_CASE("the run store's SQL is built in", "[embedded]") { CHECK(gonio::run_sql() == gonio::read_file(folder / "run.sql")); }

TEST_CASE("every example and every axis profile is built in under its name", "[embedded]") {
  const std::vector<std::string_view> names = gonio::example_names();
  CHECK(std::is_sorted(names.begin(), names.end()));
  for (const std::string_view name : names) CHECK(gonio::example_text(name) == gonio::read_file(folder / "examples" / "valid" / name));
  for (const std::string_view name : gonio::axis_profile_names())
    CHECK(gonio::axis_profile_text(name) == gonio::read_file(folder / "axis-profiles" / (std::string(name) + ".json")));
}

TEST_CASE("a name that is not built in gives an empty text", "[embedded]") {
  CHECK(gonio::example_text("no-such.bench.json").empty());
  CHECK(gonio::axis_profile_text("no-such").empty());
  CHECK(gonio::schema_file_text("no-such.schema.json").empty());
  CHECK(gonio::schema_file_text("run.sql").empty());
}
