// SPDX-License-Identifier: BSD-3-Clause
// Measurements of other laboratories through the command line, held against what they are known to say.
#include <cmath>
#include <map>
#include <string>

#include "tabulated/formats/csv.hpp"
#include "tests/command.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

/// `gonio import` of a file with these flags.
Dataset imported(const std::string& file, const std::string& flags, std::string* notes = nullptr) {
  const test::TemporaryFolder folder;
  const auto outcome = run_gonio("import " + file + " " + flags + " --out '" + (folder / "out.csv").string() + "'");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  if (notes != nullptr) *notes = outcome.err;
  return tabulated::read_csv(folder / "out.csv");
}

const std::string rt300s_columns =
    " --columns phi_o_deg=azimuth_deg,theta_i_deg=incidence_deg,theta_o_deg=receive_deg,value=RT --set phi_i_deg=90 "
    "--quantity signal_ratio";

}  // namespace

TEST_CASE("RT-300S EC1, raw minus blank, has its published means at receive 0") {
  const std::string file = test::measured_argument("loft_rt300s/raw_csv/ANOPLATE_AnoBlack_EC1_Alum6061_v1o0_20251115.csv");
  if (file.empty()) return;
  const Dataset data =
      imported(file, rt300s_columns + " --blank " + test::measured_argument("loft_rt300s/raw_csv/blank_v2o0_20250911.csv"));
  CHECK(data.size() == 2508);

  std::map<double, std::pair<double, int>> at_normal;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const GonioAngles& a = data.angles[k];
    if (a.theta_o.degrees() == 0) {
      at_normal[a.theta_i.degrees()].first += data.f[0][k];
      ++at_normal[a.theta_i.degrees()].second;
    }
  }
  REQUIRE(at_normal.size() == 4);
  constexpr double tenth_of_a_percent = 1e-3;
  for (const auto& [incidence, mean] : std::map<double, double>{{10, 0.03246}, {30, 0.02044}, {50, 0.01195}, {70, 0.00851}})
    CHECK(std::fabs(at_normal[incidence].first / at_normal[incidence].second / mean - 1) < tenth_of_a_percent);
}

TEST_CASE("CEA's retro-reflective tape imports without flags: rows at 90 degrees masked, two peaks of different nature") {
  const std::string file = test::measured_argument("alta_retro/retro-3M-jaune.dat");
  if (file.empty()) return;
  std::string notes;
  const Dataset data = imported(file, "", &notes);
  CHECK(data.size() == 7311);
  CHECK(notes.find("86 entries are no measurement") != std::string::npos);
  // The mirror peak grows with the incidence as Fresnel's reflection does, the retro-reflected one falls.
  std::map<int, std::array<double, 2>> peak;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const GonioAngles& a = data.angles[k];
    const bool back = std::cos((a.phi_o - a.phi_i).radians()) > 0;
    double& highest = peak[int(std::lround(a.theta_i.degrees()))][back ? 1 : 0];
    highest = std::max(highest, data.f[0][k] * a.theta_o.cos());
  }
  REQUIRE(peak.size() == 3);
  CHECK(peak[60][0] > 1.5 * peak[30][0]);
  CHECK(peak[60][1] < 0.8 * peak[30][1]);
}

TEST_CASE("NIST's PTFE imports with one channel per wavelength and is nearly Lambertian") {
  const std::string file = test::measured_argument("nist_ptfe/PTFE.data.csv");
  if (file.empty()) return;
  const std::string columns =
      "--columns wavelength_um=lambda,theta_i_deg=thetai,phi_i_deg=phi,theta_o_deg=thetar,phi_o_deg=phir,value=f_r11";
  std::string notes;
  const Dataset data = imported(file, columns, &notes);
  CHECK(data.size() == 1824);
  REQUIRE(data.channels.size() == 4);
  CHECK(data.channels[1].name == "532nm");
  CHECK(data.channels[3].wavelength_in_nm == 1064.0);
  CHECK(notes.find("columns left out: f_r12/f_r11") != std::string::npos);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < data.size(); ++k)
    if (data.angles[k].theta_i.degrees() < 0.01) sum += data.f[1][k], ++count;
  CHECK(std::fabs(sum / double(count) - 0.3144) < 6e-5);
  const auto fit = run_gonio("fit " + file + " " + columns + " --model lambert --json");
  REQUIRE(fit.code == 0);
  const Json document = fit.json();
  for (const Json& parameter : document.at("parameters").elements()) {
    CHECK(parameter.at("value").number() > 0.9);
    CHECK(parameter.at("value").number() < 1.0);
  }
}

TEST_CASE("A material of the RGL database goes through info, eval, check and fit") {
  const std::string file = test::measured_argument("rgl/cm_military_green_rgb.bsdf");
  if (file.empty()) return;
  const auto info = run_gonio("info " + file);
  CHECK(info.code == 0);
  CHECK(info.out.find("Military Green") != std::string::npos);
  const auto eval = run_gonio("eval " + file, "45 30 47 208\n");
  CHECK(eval.code == 0);
  CHECK(eval.out.starts_with("0.6213"));
  const auto check = run_gonio("check " + file + " --json");
  CHECK(check.json().at("checks").size() >= 4);
  const auto fit = run_gonio("fit " + file + " --model blinn-phong --metric log --json");
  INFO(fit.err);
  REQUIRE(fit.code == 0);
  CHECK(fit.json().at("n_observations").integer() > 6000);
}
