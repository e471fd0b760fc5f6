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

/// A lobe at one incidence, wrong by a smooth ripple so that it is no perfect fit.
std::string incidence(int theta_i) {
  const AnalyticBrdf model("blinn-phong", single_channel("value"), {{0.3, 0.3, 20}});
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  for (int to = 0; to < 80; to += 5)
    for (int phi = 0; phi < 360; phi += 30) {
      const double f =
          model.eval(GonioAngles{degrees(theta_i), degrees(0), degrees(to), degrees(phi)})[0] * (1 + 0.02 * std::sin(to + phi));
      text += std::to_string(theta_i) + ",0," + std::to_string(to) + "," + std::to_string(phi) + "," + std::to_string(f) + "\n";
    }
  return text;
}

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace

TEST_CASE("shards collapsed apart and merged give the fit of all files together") {
  const test::TemporaryFolder folder;
  for (const int theta : {10, 30, 50}) {
    const std::string name = std::to_string(theta);
    folder.file(name + ".csv", incidence(theta));
    const auto outcome = run_gonio("collapse " + quoted(folder / (name + ".csv")) + " --model blinn-phong --metric linear --out " +
                                   quoted(folder / (name + ".stats.json")));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_NOTHROW(load_document(folder / (name + ".stats.json"), Schema::statistics));
  }
  const auto list = [&](const char* ending) {
    std::string out;
    for (const char* name : {"10", "30", "50"}) out += quoted(folder / (std::string(name) + ending)) + " ";
    return out;
  };
  const auto merged = run_gonio("fit --merge " + list(".stats.json") + "--model blinn-phong --json");
  const auto together = run_gonio("fit --together " + list(".csv") + "--model blinn-phong --metric linear --json");
  INFO(merged.err);
  REQUIRE(merged.code == 0);
  const Json a = merged.json(), b = together.json();
  CHECK(faults_of(a, Schema::fit, "fit").empty());
  CHECK(a.at("n_observations") == b.at("n_observations"));
  CHECK(a.at("context").at("inputs").size() == 6);  // the shards, and what they were made from
  for (std::size_t k = 0; k < a.at("parameters").size(); ++k)
    CHECK(a.at("parameters")[k].at("value").number() == Approx(b.at("parameters")[k].at("value").number()).epsilon(1e-7));
  CHECK(a.at("errors").at("linear").number() == Approx(b.at("errors").at("linear").number()).epsilon(1e-9));
  CHECK(a.at("errors").at("cbrt").is_null());
}

TEST_CASE("shards that do not belong together are refused") {
  const test::TemporaryFolder folder;
  const std::string file = quoted(folder.file("a.csv", incidence(10))), other = quoted(folder.file("b.csv", incidence(30)));
  const auto collapse = [&](const std::string& of, const char* flags, const char* out) {
    return run_gonio("collapse " + of + " " + flags + " --out " + quoted(folder / out)).code;
  };
  REQUIRE(collapse(file, "--model blinn-phong --metric linear", "a.json") == 0);
  REQUIRE(collapse(other, "--model phong --metric linear", "b.json") == 0);
  const std::string a = quoted(folder / "a.json") + " ", b = quoted(folder / "b.json") + " ";
  CHECK(run_gonio("fit --merge " + a + b + "--model blinn-phong").code == 3);
  CHECK(run_gonio("fit --merge " + a + a + "--model blinn-phong").code == 3);  // the same samples twice
  CHECK(run_gonio("fit --merge " + a + "--model phong").code == 2);
  CHECK(run_gonio("fit --merge " + a + "--model blinn-phong --metric cbrt").code == 2);
  CHECK(run_gonio("fit --merge " + file + " --model blinn-phong").code == 3);
  CHECK(run_gonio("fit --merge " + a + "--model blinn-phong,phong").code == 2);
  CHECK(collapse(file, "--model phong --metric log1p", "c.json") == 2);
  CHECK(collapse(file, "--model phong", "c.json") == 2);  // single samples without u have no scatter in their sums
  CHECK(collapse("nowhere.csv", "--model phong", "c.json") == 3);
}
