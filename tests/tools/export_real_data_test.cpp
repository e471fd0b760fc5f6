// SPDX-License-Identifier: BSD-3-Clause
// gonio export of real measurements as a user runs it, to one renderer's format each, with what the notes count.
#include <cmath>

#include "data-schemas/document.hpp"
#include "tests/command.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Exports to an RGL file of the smallest size, which must hold values that gonio reads.
Json rgl_of(const std::string& arguments, const std::string& format) {
  const test::TemporaryFolder folder;
  const std::string out = quoted(folder / "material.bsdf");
  const auto outcome = run_gonio("export " + arguments + " --to " + format + " --size paper --json --out " + out);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto value = run_gonio("eval " + out, "31 0 33 180\n");
  REQUIRE(value.code == 0);
  CHECK(std::stod(value.out) > 0);
  const Json document = outcome.json();
  CHECK(faults_of(document, Schema::export_files, "").empty());
  return document;
}

void counted(const Json& document, double most_extrapolated) {
  const Json& notes = document.at("notes");
  CHECK(notes.at("n_nodes").number() > 5000);
  CHECK(notes.at("n_unknown").number() == 0);
  CHECK(notes.at("n_extrapolated").number() > 0);
  CHECK(notes.at("n_extrapolated").number() < most_extrapolated * notes.at("n_nodes").number());
}

void refused_for_one_azimuth(const std::string& arguments) {
  const test::TemporaryFolder folder;
  const auto outcome = run_gonio("export " + arguments + " --to rgl --size paper --out " + quoted(folder / "material.bsdf"));
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("one azimuth") != std::string::npos);
  CHECK(outcome.err.find("--impose isotropy") != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "material.bsdf"));
}

}  // namespace

TEST_CASE("The black coating EC1 becomes a material once isotropy is imposed; masked and extrapolated values are counted") {
  const std::string ec1 = test::measured_argument("loft_rt300s/raw_csv/ANOPLATE_AnoBlack_EC1_Alum6061_v1o0_20251115.csv");
  const std::string blank = test::measured_argument("loft_rt300s/raw_csv/blank_v2o0_20250911.csv");
  if (ec1.empty() || blank.empty()) return;
  const std::string source =
      ec1 +
      " --columns phi_o_deg=azimuth_deg,theta_i_deg=incidence_deg,theta_o_deg=receive_deg,value=RT --set phi_i_deg=90 "
      "--quantity signal_ratio --guide ggx-separable-fresnel --mask-retro 3 --blank " +
      blank;
  refused_for_one_azimuth(source);
  const Json document = rgl_of(source + " --impose isotropy,bilateral", "rgl");
  counted(document, 0.5);
  CHECK(document.at("table").at("n_masked_retro").number() == 10);
  CHECK(document.at("table").at("noise_estimated").boolean());
  CHECK(document.at("table").at("imposed").size() == 2);
  CHECK(document.at("table").at("part_beyond").number() < 0.15);
}

TEST_CASE("NIST's PTFE becomes a spectral material that is nearly white") {
  const std::string ptfe = test::measured_argument("nist_ptfe/PTFE.data.csv");
  if (ptfe.empty()) return;
  refused_for_one_azimuth(ptfe + " --guide lambert");
  const Json document = rgl_of(ptfe + " --guide lambert --impose isotropy", "rgl-spectral");
  counted(document, 0.5);
  CHECK(document.at("table").at("guides").elements()[0].at("error_alone").number() < 0.02);
}

TEST_CASE("A Cornell paint, measured on one side of the plane of incidence, becomes a material once both symmetries are imposed") {
  const std::string paint = test::measured_argument("cornell/garnet_red.brdf");
  if (paint.empty()) return;
  const Json document = rgl_of(paint + " --guide blinn-phong --impose isotropy,bilateral", "rgl");
  counted(document, 0.5);
  CHECK(document.at("samples").number() == 1439);
}

TEST_CASE("The chassis, measured in one plane, becomes no table but a model of a renderer") {
  const std::string chassis = test::measured_argument("lumos/chassis_brdf.csv");
  if (chassis.empty()) return;
  const std::string source = chassis + " --columns theta_i_deg=1,phi_i_deg=2,theta_o_deg=3,phi_o_deg=4,value=5";
  refused_for_one_azimuth(source + " --guide lambert");
  const test::TemporaryFolder folder;
  const auto outcome = run_gonio("export " + source + " --to mitsuba --json --out " + quoted(folder / "chassis.xml"));
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(test::read_file(folder / "chassis.xml").find("<bsdf") != std::string::npos);
}
