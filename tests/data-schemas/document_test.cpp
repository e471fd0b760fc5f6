// SPDX-License-Identifier: BSD-3-Clause
// Loading documents, and the context block.
#include "data-schemas/document.hpp"

#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using gonio::Json;
using gonio::Schema;

TEST_CASE("the context block is complete, in order, and what the schema wants", "[document]") {
  const gonio::test::TemporaryFolder folder;
  gonio::write_file_atomically(folder / "samples.csv", "abc");
  const Json context = gonio::context({gonio::hash_in_background(folder / "samples.csv")}, 42, true);
  std::string keys;
  for (const auto& [name, value] : context.members()) keys += name + ' ';
  CHECK(keys == "program version build_type inputs seed simulated ");
  CHECK(context.at("program").string() == "gonio");
  CHECK(context.at("inputs")[0].at("path").string() == (folder / "samples.csv").string());
  CHECK(context.at("inputs")[0].at("sha256").string() == gonio::sha256("abc"));
  CHECK(context.at("seed").integer() == 42);
  CHECK(context.at("simulated").boolean());
  const Json document = Json::object({{"context", context}, {"checks", Json::array()}});
  CHECK(gonio::faults_of(document, Schema::checks, "doc").empty());
}

TEST_CASE("without a seed the context says null, and an unreadable input is an error", "[document]") {
  const Json context = gonio::context({}, std::nullopt, false);
  CHECK(context.at("seed").is_null());
  CHECK(context.at("inputs").size() == 0);
  CHECK(gonio::faults_of(Json::object({{"context", context}, {"checks", Json::array()}}), Schema::checks, "doc").empty());
  const gonio::test::TemporaryFolder folder;
  CHECK_THROWS_AS(gonio::context({gonio::hash_in_background(folder / "missing")}, 1, false), gonio::Error);
}

TEST_CASE("a document that cannot be read, parsed or accepted is an input error", "[document]") {
  const gonio::test::TemporaryFolder folder;
  const auto faults = [&](const std::filesystem::path& path) {
    try {
      gonio::load_document(path, Schema::checks);
    } catch (const gonio::Error& error) {
      CHECK(error.kind() == gonio::ErrorKind::input);
      return error.faults();
    }
    return std::vector<gonio::Fault>{};
  };
  CHECK(faults(folder / "missing.json").size() == 1);
  CHECK(faults(folder.path()).size() == 1);
  CHECK(faults("").size() == 1);
  CHECK(faults(std::string(5000, 'n')).size() == 1);
  gonio::write_file_atomically(folder / "syntax.json", "{\n  \"context\": }");
  CHECK(faults(folder / "syntax.json").at(0).where == (folder / "syntax.json").string() + ":2:14");
  gonio::write_file_atomically(folder / "schema.json", "{\"checks\": 5}");
  CHECK(faults(folder / "schema.json").at(1).where == (folder / "schema.json").string() + "#/checks");
  CHECK(faults(folder / "schema.json").size() == 2);
}
