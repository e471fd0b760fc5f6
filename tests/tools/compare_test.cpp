// SPDX-License-Identifier: BSD-3-Clause
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

const std::string models =
    "compare phong phong --param-a rho_d=.3 --param-a rho_s=.2 --param-a s=50 --param-b rho_d=.3 --param-b rho_s=.2 --param-b s=40 ";

}  // namespace

TEST_CASE("compare of two models writes its document and its pictures") {
  const test::TemporaryFolder folder;
  const auto outcome = run_gonio(models + "--json --out '" + (folder / "out").string() + "'");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::compare, "").empty());
  CHECK(document.at("compared_at").string() == "quadrature");
  CHECK(document.at("metrics").size() == 6);
  CHECK(document.at("largest").at("absolute").at("difference").number() < 0);
  CHECK(document.at("images").size() == 2);
  CHECK(test::read_file(folder / "out" / "compare.json") == document.dump(2) + "\n");
  CHECK(test::read_file(folder / "out" / "difference.png").starts_with("\x89PNG"));
  CHECK(test::read_file(folder / "out" / "difference.exr").starts_with("\x76\x2f\x31\x01"));
}

TEST_CASE("compare of a file with itself finds no difference; its uncertainties give a chi²") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "a.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,40,180,.5,.01\n30,0,50,180,.4,.01\n");
  const std::string file = "'" + (folder / "a.csv").string() + "'";
  const auto outcome = run_gonio("compare " + file + " " + file + " --json");
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::compare, "").empty());
  CHECK(document.at("compared_at").string() == "common-directions");
  for (const Json& metric : document.at("metrics").elements())
    if (!metric.at("absolute").is_null()) CHECK(metric.at("absolute").number() == 0);
  CHECK(document.at("chi_square").at("correlated_per_n").number() == 0);
  const auto text = run_gonio("compare " + file + " lambert --param-b rho_d=1");
  CHECK(text.code == 0);
  CHECK(text.out.find("largest difference") != std::string::npos);
}

TEST_CASE("compare refuses a picture of another kind, channels that do not match and parameters of a file") {
  const test::TemporaryFolder folder;
  CHECK(run_gonio(models + "--image '" + (folder / "x.jpg").string() + "'").code == 2);
  test::write_file(folder / "ab.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,a,b\n30,0,40,180,.5,.5\n");
  test::write_file(folder / "cd.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,c,d\n30,0,40,180,.5,.5\n");
  const std::string ab = "'" + (folder / "ab.csv").string() + "'", cd = "'" + (folder / "cd.csv").string() + "'";
  const auto channels = run_gonio("compare " + ab + " " + cd);
  CHECK(channels.code == 3);
  CHECK(channels.err.find("a, b in A and c, d in B") != std::string::npos);
  CHECK(run_gonio("compare " + ab + " " + ab + " --param-a s=1").code == 2);
  CHECK(run_gonio("compare " + ab + " no-such-file").code == 3);
}
