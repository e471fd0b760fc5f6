// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "brdf/analytic_brdf.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("eval prints a model's values with 17 digits, line by line") {
  const auto outcome = run_gonio("eval blinn-phong --param rho_d=.05 --param rho_s=.93 --param s=8.764",
                                 "# a comment\n30 0 30 180\n\n60 10 20 250\n95 0 10 0\n");
  REQUIRE(outcome.code == 0);
  const AnalyticBrdf model("blinn-phong", single_channel("value"), {{0.05, 0.93, 8.764}});
  std::istringstream lines(outcome.out);
  double first = 0, second = 0, below = 1;
  lines >> first >> second >> below;
  CHECK(first == model.eval(GonioAngles{30_deg, 0_deg, 30_deg, 180_deg})[0]);
  CHECK(second == model.eval(GonioAngles{60_deg, 10_deg, 20_deg, 250_deg})[0]);
  CHECK(below == 0);
}

TEST_CASE("eval prints the directional albedo") {
  const auto outcome = run_gonio("eval blinn-phong --param rho_d=.05 --param rho_s=.93 --param s=8.764 --albedo", "0 0\n90 0\n120 0\n");
  REQUIRE(outcome.code == 0);
  std::istringstream lines(outcome.out);
  double normal = 0, grazing = 0, below = 1;
  lines >> normal >> grazing >> below;
  CHECK(normal == Approx(1.0499).margin(5e-5));
  CHECK(grazing == Approx(0.05 + 0.93 * (8.764 + 8) / ((8.764 + 2) * (8.764 + 4))));
  CHECK(below == 0);
}

TEST_CASE("eval refuses what is no direction and parameters that are not complete") {
  CHECK(run_gonio("eval lambert --param rho_d=.5", "30 0 30\n").code == 3);
  CHECK(run_gonio("eval lambert --param rho_d=.5", "30 0 30 nan\n").code == 3);
  CHECK(run_gonio("eval lambert --param rho_d=.5", "30 0 x 180\n").code == 2);
  const auto missing = run_gonio("eval blinn-phong --param rho_d=.5 --param shininess=4", "30 0 30 180\n");
  CHECK(missing.code == 2);
  CHECK(missing.out.empty());
  CHECK(missing.err.find("shininess") != std::string::npos);
  CHECK(missing.err.find("rho_s") != std::string::npos);
  CHECK(run_gonio("eval lambert --param rho_d=-1", "30 0 30 180\n").code == 2);
}

TEST_CASE("eval gives JSON with the context first") {
  const auto outcome = run_gonio("eval lambert --param rho_d=.5 --json", "30 0 30 180\n");
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(document.members().front().first == "context");
  CHECK(document.at("values")[0][0].number() == Approx(0.5 / std::numbers::pi));
}
