// SPDX-License-Identifier: BSD-3-Clause
// gonio fit --nuisance: what it prints, what it refuses.
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// In the plane of incidence, the normal leans by `lean_deg` towards the source: the mirror direction appears 2 · lean off. Half of the
/// readings were taken in a range that is 3 % off; a common scale is stated.
std::string sweep(double lean_deg, bool with_range, const std::string& head = "") {
  const AnalyticBrdf truth("blinn-phong", single_channel("Y"), {{.2, .3, 100}});
  std::string text = std::string("# gonio samples 1\n# channel.1: value\n") + (with_range ? "# correlated.range: 0.05\n" : "") + head +
                     "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value" + (with_range ? ",c_range" : "") + "\n";
  for (int i = 10; i <= 60; i += 10)
    for (int o = 0; o <= 80; o += 2) {
      const double f = truth.eval({degrees(i - lean_deg), degrees(0), degrees(o + lean_deg), degrees(180)})[0];
      const bool range = with_range && f > .2;
      // A fixed pattern of one in a hundred stands for noise.
      const double noise = .01 * std::sin(12.9898 * i + 78.233 * o);
      text += fmt::format("{},0,{},180,{:.12g},{:.6g}{}\n", i, o, f * (1 + noise) * (range ? 1.03 : 1), .01 * f,
                          with_range ? (range ? ",1" : ",0") : "");
    }
  return text;
}

const Json& named(const Json& document, const char* list, const std::string& name) {
  for (const Json& p : document.at(list).elements())
    if (p.at("name").string() == name) return p;
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("fit --nuisance finds a tilt and a range that is off, and says what the data do not determine") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "tilted.csv", sweep(.5, true, "# correlated.certificate: 0.02\n"));
  const std::string command = "fit " + quoted(folder / "tilted.csv") + " --model blinn-phong --nuisance tilt,azimuth,components";
  const auto outcome = run_gonio(command + " --json");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::fit, "fit").empty());
  CHECK(document.at("u_scale").number() == Approx(.02));
  CHECK(document.at("options").at("nuisance").string() == "tilt,azimuth,components");
  CHECK(named(document, "nuisance", "tilt_x").at("value").number() == Approx(.5).margin(.05));
  CHECK(named(document, "nuisance", "range").at("value").number() == Approx(std::log(1.03)).margin(.01));
  CHECK(named(document, "nuisance", "range").at("prior").number() == Approx(.05));
  CHECK(named(document, "nuisance", "azimuth").at("sigma").is_null());
  CHECK(named(document, "parameters", "s").at("value").number() == Approx(100).epsilon(.03));
  const std::string text = run_gonio(command).out;
  CHECK(text.find("tilt_x") != std::string::npos);
  CHECK(text.find("held at 0") != std::string::npos);
  CHECK(text.find("stated ± 0.05") != std::string::npos);
  CHECK(text.find("common scale of all samples ± 2 %") != std::string::npos);
  // Without the flag there is no such thing, and the tilt shows in what is fitted.
  const Json plain = run_gonio("fit " + quoted(folder / "tilted.csv") + " --model blinn-phong --json").json();
  CHECK(plain.at("nuisance").elements().empty());
  CHECK(plain.at("errors").at("chi2_per_dof").number() > 2 * document.at("errors").at("chi2_per_dof").number());
}

TEST_CASE("a list of models is ranked with nuisance parameters too") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "tilted.csv", sweep(.5, true));
  const auto outcome = run_gonio("fit " + quoted(folder / "tilted.csv") + " --model lambert,blinn-phong --nuisance tilt,components --json");
  INFO(outcome.err);
  CHECK(outcome.json().at("best").string() == "blinn-phong");
}

TEST_CASE("fit --nuisance is refused where it cannot be, and a batch goes on") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  test::write_file(folder / "in" / "a.csv", sweep(0, true));
  test::write_file(folder / "in" / "b.csv", sweep(0, false));
  CHECK(run_gonio("fit " + quoted(folder / "in" / "a.csv") + " --model lambert --nuisance drift").code == 2);
  const auto none = run_gonio("fit " + quoted(folder / "in" / "b.csv") + " --model blinn-phong --nuisance components");
  CHECK(none.code == 3);
  CHECK(none.err.find("no correlated component that changes the shape") != std::string::npos);
  const auto batch = run_gonio("fit " + quoted(folder / "in") + " --model blinn-phong --nuisance components --ordered");
  CHECK(batch.out.find("\"range\"") != std::string::npos);
  CHECK(batch.out.find("no correlated component that changes the shape") != std::string::npos);
  REQUIRE(run_gonio("collapse " + quoted(folder / "in" / "b.csv") + " --model blinn-phong --out " + quoted(folder / "b.json")).code == 0);
  const auto merged = run_gonio("fit " + quoted(folder / "b.json") + " --merge --model blinn-phong --nuisance tilt");
  CHECK(merged.code == 2);
  CHECK(merged.err.find("sums over samples") != std::string::npos);
}
