// SPDX-License-Identifier: BSD-3-Clause
// What the program says and returns when something is wrong.
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("every verb has a help text") {
  for (const char* verb : {"demo", "plan", "serve", "sweep", "reduce", "import", "fit", "check", "export", "eval", "info"}) {
    const auto outcome = run_gonio(std::string(verb) + " --help");
    INFO(verb);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("--json") != std::string::npos);
    CHECK(run_gonio("--help").out.find(verb) != std::string::npos);
  }
}

TEST_CASE("wrong usage exits 2 and says what was wanted") {
  CHECK(run_gonio("").code == 2);
  CHECK(run_gonio("measure").code == 2);
  CHECK(run_gonio("fit --no-such-flag").code == 2);
  CHECK(run_gonio("fit x.csv --model blin-phong").code == 2);
  CHECK(run_gonio("fit x.csv --model phong --metric squared").code == 2);
  CHECK(run_gonio("import x.csv --out y.csv --quantity radiance").code == 2);
  CHECK(run_gonio("export x.csv --to obj --out y").code == 2);
  CHECK(run_gonio("info").err.find("FILE") != std::string::npos);
}

TEST_CASE("a file that is not there exits 3, with nothing on standard output") {
  for (const char* verb :
       {"fit /nowhere.csv --model phong", "check /nowhere.csv", "info /nowhere.csv", "import /nowhere.csv --out /tmp/x.csv",
        "reduce /nowhere.gonio --out /tmp/x.csv", "plan /nowhere.json --bench /nowhere.json", "serve /nowhere.json"}) {
    const auto outcome = run_gonio(verb);
    INFO(verb << ": " << outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("/nowhere") != std::string::npos);
  }
}

TEST_CASE("with --json an error is one object on standard error") {
  const auto outcome = run_gonio("fit /nowhere.csv --model phong --json");
  CHECK(outcome.code == 3);
  CHECK(outcome.out.empty());
  const Json error = parse_json(outcome.err, "standard error");
  CHECK(error.at("error").at("kind").string() == "input");
  REQUIRE(error.at("error").at("faults").size() == 1);
  CHECK(error.at("error").at("faults")[0].at("where").string().find("/nowhere.csv") != std::string::npos);
}
