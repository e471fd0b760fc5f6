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

TEST_CASE("eval interpolates samples as their ratio to a guide, with uncertainty and coverage in the document, unless told otherwise") {
  const test::TemporaryFolder folder;
  std::string directions, rows =
                              "# gonio samples 1\n# channel.1: value\n# symmetry: isotropic\n# side: "
                              "reflection\ntheta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  const AnalyticBrdf truth("phong", single_channel("value"), {{0.2, 0.3, 100}});
  for (int ti = 10; ti <= 70; ti += 20)
    for (int to = 0; to <= 80; to += 5)
      for (int phi = 0; phi < 360; phi += 15) {
        if (to == 0 && phi > 0) continue;
        const double f = truth.eval(GonioAngles{degrees(ti), 0_deg, degrees(to), degrees(phi)})[0];
        rows += std::to_string(ti) + ",0," + std::to_string(to) + "," + std::to_string(phi) + "," + std::to_string(f) + "," +
                std::to_string(0.01 * f) + "\n";
      }
  test::write_file(folder / "samples.csv", rows);
  const std::string peak = "40 0 40 180\n", source = "eval '" + (folder / "samples.csv").string() + "'";
  const double wanted = truth.eval(GonioAngles{40_deg, 0_deg, 40_deg, 180_deg})[0];
  const auto outcome = run_gonio(source + " --guide phong --json", peak + "88 0 88 0\n30 0 30 0\n");
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(document.at("values")[0][0].number() == Approx(wanted).epsilon(0.01));
  CHECK(document.at("u")[0][0].number() > 0);
  CHECK(document.at("u")[0][0].number() < 0.05 * wanted);
  CHECK(document.at("coverage")[0].string() == "interpolated");
  CHECK(document.at("coverage")[1].string() == "extrapolated");
  CHECK(document.at("coverage")[2].string() == "measured");
  CHECK(outcome.err.find("1 of 3 values lie beyond the samples") != std::string::npos);
  CHECK(run_gonio(source + " --guide phong --extrapolate no", "88 0 88 0\n").out == "nan\n");
  const auto nearest = run_gonio(source + " --nearest", peak);
  CHECK(std::stod(nearest.out) < 0.7 * wanted);  // nobody told it that there is a peak
  const auto compared =
      run_gonio("compare phong --param-a rho_d=.2 --param-a rho_s=.3 --param-a s=100 '" + (folder / "samples.csv").string() + "'");
  CHECK(compared.code == 0);
}
