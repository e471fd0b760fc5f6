// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string verdict(const Json& document, const std::string& id) {
  for (const Json& check : document.at("checks").elements())
    if (check.at("id").string() == id) return check.at("verdict").string();
  return "absent";
}

/// Pairs of exchanged directions with 0.5 % noise uncertainty and the second of each pair larger by `asymmetry`.
std::string pairs(double asymmetry) {
  const AnalyticBrdf model("blinn-phong", single_channel("value"), {{0.3, 0.3, 20}});
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  const auto row = [&](double ti, double to, double phi, double factor) {
    const double f = model.eval(GonioAngles{degrees(ti), degrees(0), degrees(to), degrees(phi)})[0] * factor;
    text += std::to_string(ti) + ",0," + std::to_string(to) + "," + std::to_string(phi) + "," + std::to_string(f) + "," +
            std::to_string(0.005 * f) + "\n";
  };
  for (int ti = 10; ti <= 60; ti += 10)
    for (int to = 10; to < ti; to += 10)
      for (int phi = 0; phi < 360; phi += 30) {
        row(ti, to, phi, 1);
        // the exchanged pair: (to, φi = 0) -> (ti, -phi), an isotropic sample turned
        row(to, ti, 360 - phi, 1 + asymmetry);
      }
  return text;
}

}  // namespace

TEST_CASE("a model that reflects more than it receives fails the energy check") {
  const auto outcome = run_gonio("check blinn-phong --param rho_d=.05 --param rho_s=.93 --param s=8.764 --json");
  CHECK(outcome.code == 1);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::checks, "checks").empty());
  CHECK(verdict(document, "energy") == "fail");
  CHECK(outcome.out.find("1.0499") != std::string::npos);
  const auto exact = run_gonio("check blinn-phong-exact --param rho_d=.05 --param rho_s=.93 --param s=8.764 --json");
  CHECK(exact.code == 0);
  CHECK(verdict(exact.json(), "energy") == "pass");
}

TEST_CASE("check finds asymmetry beyond the margin and exits 1, and none where there is none") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "fair.csv", pairs(0));
  test::write_file(folder / "lopsided.csv", pairs(0.05));
  const auto fair = run_gonio("check '" + (folder / "fair.csv").string() + "' --json");
  const auto lopsided = run_gonio("check '" + (folder / "lopsided.csv").string() + "' --json");
  INFO(fair.out << fair.err << lopsided.out);
  CHECK(verdict(fair.json(), "reciprocity") != "fail");
  CHECK(verdict(lopsided.json(), "reciprocity") == "fail");
  CHECK(lopsided.code == 1);
}

TEST_CASE("check refuses as many rotations as there are no files for") {
  CHECK(run_gonio("check a.csv b.csv --rotation 0,45,90").code == 2);
  CHECK(run_gonio("check a.csv --margin -1").code == 2);
}
