// SPDX-License-Identifier: BSD-3-Clause
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("a ten-hour sweep gives the same file for the same seed, and another for another") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "bench.json", std::string(example_text("demo.bench.json")));
  test::write_file(folder / "plan.json", std::string(example_text("ten-hours.plan.json")));
  const auto sweep = [&](const std::string& out, const std::string& flags) {
    const auto outcome = run_gonio("sweep '" + (folder / "plan.json").string() + "' --bench '" + (folder / "bench.json").string() +
                                   "' --out '" + (folder / out).string() + "' --json " + flags);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return outcome.json();
  };
  const Json result = sweep("a.gonio", "");
  CHECK(result.at("bench_s").number() > 9 * 3600.0);
  CHECK(result.at("bench_s").number() < 11 * 3600.0);
  CHECK(result.at("measured").integer() >= 2600);
  sweep("b.gonio", "");
  sweep("c.gonio", "--seed 99");
  const std::string a = sha256_of_file(folder / "a.gonio");
  CHECK(sha256_of_file(folder / "b.gonio") == a);
  CHECK(sha256_of_file(folder / "c.gonio") != a);
}
