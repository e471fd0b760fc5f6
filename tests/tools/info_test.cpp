// SPDX-License-Identifier: BSD-3-Clause
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("info knows a bench, a plan and samples by content") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "a", std::string(example_text("demo.bench.json")));
  test::write_file(folder / "b", std::string(example_text("demo.plan.json")));
  test::write_file(folder / "c", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,0.5\n");
  CHECK(run_gonio("info '" + (folder / "a").string() + "'").out.find("bench (simulated)") != std::string::npos);
  CHECK(run_gonio("info '" + (folder / "b").string() + "'").out.find("plan") != std::string::npos);
  const auto samples = run_gonio("info '" + (folder / "c").string() + "'");
  INFO(samples.err);
  CHECK(samples.out.find("csv") != std::string::npos);
}

TEST_CASE("info refuses what it does not know") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "noise", std::string("\x01\x02\x03\x00garbage", 11));
  CHECK(run_gonio("info '" + (folder / "noise").string() + "'").code == 3);
  test::write_file(folder / "other.json", "{\"a\": 1}");
  CHECK(run_gonio("info '" + (folder / "other.json").string() + "'").code == 3);
}
