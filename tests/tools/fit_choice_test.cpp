// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

/// Exact values of a lobe, with a stated uncertainty of 1 %.
std::string lobe_csv() {
  const AnalyticBrdf model("phong", single_channel("value"), {{0.3, 0.3, 20}});
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  for (const int ti : {10, 30, 50})
    for (int to = 0; to < 80; to += 5)
      for (int phi = 0; phi < 360; phi += 30) {
        const double f = model.eval(GonioAngles{degrees(ti), degrees(0), degrees(to), degrees(phi)})[0];
        text += std::to_string(ti) + ",0," + std::to_string(to) + "," + std::to_string(phi) + "," + std::to_string(f) + "," +
                std::to_string(0.01 * f) + "\n";
      }
  return text;
}

}  // namespace

TEST_CASE("fit --model all gives a valid choice with every model in it and the true one best") {
  const test::TemporaryFolder folder;
  const std::string file = "'" + folder.file("lobe.csv", lobe_csv()).string() + "'";
  const auto outcome = run_gonio("fit " + file + " --model all --json --out '" + (folder / "choice.json").string() + "'");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::choice, "choice").empty());
  CHECK(load_document(folder / "choice.json", Schema::choice) == document);
  CHECK(document.at("candidates").size() + 2 >= model_infos().size());  // models of many nonlinear parameters must be named
  CHECK(document.at("adequate").boolean());
  CHECK(document.at("context").at("inputs").size() == 1);
  CHECK(document.at("options").at("model").string().find("lambert,") != std::string::npos);

  const auto some = run_gonio("fit " + file + " --model phong,lambert --jobs 1 --margin 0.05");
  REQUIRE(some.code == 0);
  CHECK(some.out.find("leave one incidence out (3 incidences)") != std::string::npos);
  CHECK(some.out.find("phong misses left-out samples by") != std::string::npos);
  CHECK(some.out.find("adequate, the margin is 5 %") != std::string::npos);
}

TEST_CASE("a choice that cannot be made says so") {
  const test::TemporaryFolder folder;
  const std::string header = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  const std::string negative = "'" + folder.file("negative.csv", header + "30,0,30,180,-0.1\n30,0,40,180,-0.2\n").string() + "'";
  const auto nothing = run_gonio("fit " + negative + " --model lambert,phong --metric log --json");
  CHECK(nothing.code == 1);
  CHECK(nothing.json().at("best").is_null());
  CHECK(run_gonio("fit " + negative + " --model lambert,no-such").code == 2);
  CHECK(run_gonio("fit " + negative + " " + negative + " --model all").code == 2);
  CHECK(run_gonio("fit " + negative + " --model all --folds 1").code == 2);
  CHECK(run_gonio("fit nowhere.csv --model all").code == 3);
}
