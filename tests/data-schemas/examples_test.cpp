// SPDX-License-Identifier: BSD-3-Clause
// Every example of data-schemas/examples: the valid ones load, the invalid ones are refused at exactly the places their .faults file lists.
// The part of the file name before `.json` names the schema; a line of .faults is `#` and a JSON pointer, or `:line:column`.
#include <algorithm>
#include <set>
#include <sstream>

#include "data-schemas/document.hpp"
#include "tests/check.hpp"

namespace fs = std::filesystem;
using gonio::Schema;

namespace {

const fs::path examples = fs::path(GONIO_SOURCE_DIR) / "data-schemas" / "examples";

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Schema schema_of(const fs::path& file) {
  const std::string stem = file.stem();
  for (const Schema schema : gonio::every_schema)
    if (stem.ends_with(std::string(".") + name(schema))) return schema;
  FAIL(file << " names no schema");
  return Schema::fit;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::istringstream text(gonio::read_file(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("every valid example loads", "[examples]") {
  for (const fs::path& file : files_in(examples / "valid", ".json")) {
    INFO(file);
    CHECK_NOTHROW(gonio::load_document(file, schema_of(file)));
  }
}

TEST_CASE("every built-in axis profile is valid", "[examples]") {
  for (const std::string_view name : gonio::axis_profile_names()) {
    INFO(name);
    CHECK(gonio::faults_of(gonio::parse_json(gonio::axis_profile_text(name), "profile"), Schema::axis_profile, "").empty());
  }
  SUCCEED("none is left");
}

TEST_CASE("every invalid example is refused for exactly its stated reasons", "[examples]") {
  for (const fs::path& file : files_in(examples / "invalid", ".json")) {
    INFO(file);
    std::vector<std::string> found;
    try {
      gonio::load_document(file, schema_of(file));
    } catch (const gonio::Error& error) {
      CHECK(error.kind() == gonio::ErrorKind::input);
      for (const gonio::Fault& fault : error.faults()) {
        INFO(fault.where << " | " << fault.found << " | " << fault.wanted);
        CHECK(fault.where.starts_with(file.string()));
        CHECK_FALSE(fault.found.empty());
        CHECK_FALSE(fault.wanted.empty());
        found.push_back(fault.where.substr(file.string().size()));
      }
    }
    CHECK(found == lines_of(fs::path(file).replace_extension(".faults")));
  }
}

TEST_CASE("every .faults file belongs to an example, and every schema has an example of each kind", "[examples]") {
  for (const fs::path& file : files_in(examples / "invalid", ".faults")) CHECK(fs::exists(fs::path(file).replace_extension(".json")));
  for (const char* kind : {"valid", "invalid"}) {
    std::set<Schema> seen;
    for (const fs::path& file : files_in(examples / kind, ".json")) seen.insert(schema_of(file));
    if (kind == std::string_view("valid") && !gonio::axis_profile_names().empty())
      seen.insert(Schema::axis_profile);  // the built-in profiles are its valid examples
    for (const Schema schema : gonio::every_schema) {
      INFO(kind << ' ' << name(schema));
      const bool is_there = !gonio::schema_file_text(std::string(name(schema)) + ".schema.json").empty();
      CHECK(seen.contains(schema) == is_there);
    }
  }
}
