// SPDX-License-Identifier: BSD-3-Clause
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("the demo leaves every artefact, valid and not vacuous") {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const auto outcome = run_gonio("demo '" + out + "'");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  for (const char* file : {"run.gonio", "samples.csv", "table.brdf.exr", "fit.json", "checks.json", "export/material.bsdf",
                           "export/material.xml", "export/material.binary", "lobe.png"}) {
    INFO(file);
    CHECK(std::filesystem::exists(folder / "out" / file));
  }
  CHECK(load_document(folder / "out" / "fit.json", Schema::fit).at("status").string() == "converged");
  const Json checks = load_document(folder / "out" / "checks.json", Schema::checks);
  REQUIRE(checks.at("checks").size() >= 4);
  for (const Json& check : checks.at("checks").elements()) {
    INFO(check.at("id").string() << ": " << check.at("detail").string());
    CHECK(check.at("verdict").string() == "pass");
  }
  CHECK(std::filesystem::file_size(folder / "out" / "export" / "material.binary") == 34992012);
  // A PNG of some size: the picture itself is looked at by people.
  const std::string png = test::read_file(folder / "out" / "lobe.png");
  CHECK(png.starts_with("\x89PNG"));
  CHECK(png.size() > 20000);

  // Every artefact opens again.
  for (const char* file : {"run.gonio", "samples.csv", "table.brdf.exr", "fit.json", "export/material.bsdf", "export/material.binary"}) {
    const auto info = run_gonio("info '" + (folder / "out" / file).string() + "'");
    INFO(file << info.err);
    CHECK(info.code == 0);
  }
  // A second demo into the same folder is refused and changes nothing.
  const std::string before = test::read_file(folder / "out" / "fit.json");
  CHECK(run_gonio("demo '" + out + "'").code == 3);
  CHECK(test::read_file(folder / "out" / "fit.json") == before);
}
