// SPDX-License-Identifier: BSD-3-Clause
#include "tests/command.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("import turns a mapped file into ours and counts what is no measurement") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "in.txt",
                   "# instrument file\n30 0 40 180 0.5\n30 0 50 180 nan\n30 0 60 180 -1\n30 0 95 180 0.2\n30 0 90 180 0.25\n");
  const auto outcome =
      run_gonio("import '" + (folder / "in.txt").string() +
                "' --columns theta_i_deg=1,phi_i_deg=2,theta_o_deg=3,phi_o_deg=4,value=5 --quantity reflectance_factor --out '" +
                (folder / "out.csv").string() + "' --json");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json masked = outcome.json().at("n_masked");
  CHECK(masked.at("nan").integer() == 1);
  CHECK(masked.at("missing").integer() == 1);
  CHECK(masked.at("below_horizon").integer() == 1);
  CHECK(outcome.json().at("samples").integer() == 2);
  CHECK(outcome.err.find("3 entries are no measurement") != std::string::npos);
  const auto value = run_gonio("info '" + (folder / "out.csv").string() + "'");
  CHECK(value.code == 0);
}

TEST_CASE("a CSV with text, a missing column or a wrong number of columns is refused with every line named, and nothing is written") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "bad.csv",
                   "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,0.5\n30,0,x,180,0.5\n30,0,40,180\n30,0,40,180,inf\n");
  const auto bad = run_gonio("import '" + (folder / "bad.csv").string() + "' --out '" + (folder / "out.csv").string() + "'");
  CHECK(bad.code == 3);
  for (const char* line : {"bad.csv:3", "bad.csv:4", "bad.csv:5"}) CHECK(bad.err.find(line) != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "out.csv"));
  test::write_file(folder / "short.csv", "theta_i_deg,theta_o_deg,value\n30,40,0.5\n");
  const auto missing = run_gonio("import '" + (folder / "short.csv").string() + "' --out '" + (folder / "out.csv").string() + "'");
  CHECK(missing.code == 3);
  CHECK(missing.err.find("phi") != std::string::npos);
}

TEST_CASE("import, EXR and back keep the samples") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "in.csv",
                   "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,40,180,0.5,0.01\n30,0,50,180,0.25,0.005\n60,0,50,180,0."
                   "125,0.0025\n");
  REQUIRE(run_gonio("import '" + (folder / "in.csv").string() + "' --out '" + (folder / "t.brdf.exr").string() + "'").code == 0);
  REQUIRE(run_gonio("import '" + (folder / "t.brdf.exr").string() + "' --out '" + (folder / "back.csv").string() + "' --json")
              .json()
              .at("samples")
              .integer() == 3);
  CHECK(test::read_file(folder / "back.csv").find("0.125") != std::string::npos);
}
