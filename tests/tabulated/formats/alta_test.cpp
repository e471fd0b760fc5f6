// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/alta.hpp"

#include <cmath>
#include <random>

#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double rounding = 1e-12;

const std::string projected =
    "#SAMPLE \"a tape\"\n#DIM 3 1\n#VS 0\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n";

Opened open(const std::string& text) {
  const test::TemporaryFolder scratch;
  return open_brdf(scratch.file("file.dat", text));
}

}  // namespace

TEST_CASE("Projected directions become angles: +theta_i is the way back, -theta_i the mirror direction; the cosine is taken out") {
  const Opened opened = open(projected + "0.5 0.5 0 2\n0.5 -0.5 0 3\n0.5 0 0.8 1\n0.5 0 0 4\n");
  CHECK(opened.format == "alta");
  REQUIRE(opened.dataset);
  const Dataset& data = *opened.dataset;
  REQUIRE(data.size() == 4);
  CHECK(data.symmetry.isotropic);
  CHECK(std::fabs((data.angles[0].phi_o - data.angles[0].phi_i).radians()) < rounding);
  CHECK(std::fabs((data.angles[1].phi_o - data.angles[1].phi_i).degrees() - 180) < 1e-9);
  CHECK(std::fabs(data.angles[2].phi_o.degrees() - 90) < 1e-9);
  CHECK(std::fabs(data.angles[2].theta_o.radians() - 0.8) < rounding);
  CHECK(std::fabs(data.f[0][1] - 3 / std::cos(0.5)) < rounding);
  CHECK(data.f[0][3] == 4);
  CHECK(data.provenance.at("sample") == "a tape");
}

TEST_CASE("Rows at and beyond the horizon, missing and without a number are masked and counted") {
  const Opened opened = open(projected + "0.5 1.5707963267948966 0 2\n0.5 1.7 0 3\n0.5 0 0.8 -1\n0.5 0 0.8 nan\n0.5 0.1 0 1\n");
  CHECK(opened.dataset->size() == 1);
  CHECK(opened.masked.nan == 2);
  CHECK(opened.masked.below_horizon == 1);
  CHECK(opened.masked.missing == 1);
}

TEST_CASE("Other parameterisations and three values per row read too") {
  const Opened rgb = open("#DIM 4 3\n#PARAM_IN SPHERICAL_TL_PL_TV_PV\n#PARAM_OUT INV_STERADIAN\n0.5 1 0.25 2 .1 .2 .3\n");
  CHECK(rgb.dataset->channels == rgb_channels());
  CHECK(rgb.dataset->f[2][0] == .3);
  CHECK(rgb.dataset->angles[0].phi_i.radians() == 1);
  CHECK_FALSE(rgb.dataset->symmetry.isotropic);
  const Opened difference = open("#DIM 3 1\n#PARAM_IN ISOTROPIC_TV_TL_DPHI\n#PARAM_OUT INV_STERADIAN\n0.5 0.25 3 1\n");
  CHECK(difference.dataset->angles[0].theta_i.radians() == 0.25);
  CHECK(difference.dataset->angles[0].phi_o.radians() == 3);
}

TEST_CASE("Half-difference coordinates read too; a slice is refused until one says where it lies") {
  const Opened half = open("#DIM 3 3\n#PARAM_IN RUSIN_TH_TD_PD\n#PARAM_OUT RGB_COLOR\n0.25 0.5 1 .1 .2 .3\n");
  const HalfDifference at = half_difference(half.dataset->angles[0]);
  CHECK(std::fabs(at.theta_h.radians() - 0.25) < rounding);
  CHECK(std::fabs(at.theta_d.radians() - 0.5) < rounding);
  CHECK(std::fabs(at.phi_d.radians() - 1) < rounding);
  CHECK(half.dataset->symmetry.isotropic);

  const std::string slice = "#DIM 1 3\n#PARAM_IN COS_TH\n#PARAM_OUT RGB_COLOR\n0.9 .1 .2 .3\n";
  const std::string faults = test::faults_of([&] { open(slice); });
  CHECK(faults.find("--assume theta_d_deg=DEGREES") != std::string::npos);
  CHECK(faults.find("--assume phi_d_deg=DEGREES") != std::string::npos);
  const test::TemporaryFolder scratch;
  ReadOptions options;
  options.assume = {{"theta_d_deg", "30"}, {"phi_d_deg", "90"}};
  const Opened answered = open_brdf(scratch.file("x", slice), options);
  const HalfDifference there = half_difference(answered.dataset->angles[0]);
  CHECK(std::fabs(there.theta_h.cos() - 0.9) < rounding);
  CHECK(std::fabs(there.theta_d.degrees() - 30) < 1e-9);
  CHECK(std::fabs(there.phi_d.degrees() - 90) < 1e-9);
}

TEST_CASE("The published slice of a pink felt is refused for a reason, and read with an answer") {
  const auto path = test::measured_data("alta_misc/pink-felt-1d.alta");
  if (!path) return;
  CHECK(test::faults_of([&] { open_brdf(*path); }).find("a slice at one theta_d_deg") != std::string::npos);
  ReadOptions options;
  options.assume = {{"theta_d_deg", "0"}, {"phi_d_deg", "0"}};
  CHECK(open_brdf(*path, options).dataset->size() > 80);
}

TEST_CASE("Samples written come back: with absolute azimuths, and by half and difference where the BRDF is isotropic") {
  const test::TemporaryFolder scratch;
  Dataset data;
  data.channels = rgb_channels();
  data.symmetry.isotropic = true;
  data.angles = {{30_deg, 20_deg, 40_deg, 180_deg}, {60_deg, 0_deg, 10_deg, 300_deg}, {0_deg, 0_deg, 45_deg, 90_deg}};
  data.f = {{1.0 / 3, 2e-9, 1}, {0.1, -0.2, std::nan("")}, {0.3, 0.4, 1}};
  data.u = data.f;
  for (auto& column : data.u) column.assign(3, 0.1);
  Opened source;
  source.dataset = std::make_shared<const Dataset>(data);
  for (const bool half : {false, true}) {
    const ExportNotes notes = (half ? write_alta_half : write_alta)(source, scratch / "x.alta", {});
    CHECK(notes.lost.size() == 2);  // the row with an unknown value, the uncertainties
    const Opened read = open_brdf(scratch / "x.alta");
    REQUIRE(read.dataset->size() == 2);
    CHECK(read.dataset->symmetry.isotropic);
    for (std::size_t k = 0; k < 2; ++k) {
      const HalfDifference a = half_difference(read.dataset->angles[k]), b = half_difference(data.angles[k]);
      CHECK(std::fabs(a.theta_h.radians() - b.theta_h.radians()) < rounding);
      CHECK(std::fabs(a.theta_d.radians() - b.theta_d.radians()) < rounding);
      CHECK(std::fabs(std::remainder(a.phi_d.degrees() - b.phi_d.degrees(), 360)) < 1e-9);
      for (std::size_t c = 0; c < 3; ++c) CHECK(read.dataset->f[c][k] == data.f[c][k]);
    }
  }
  data.symmetry.isotropic = false;
  source.dataset = std::make_shared<const Dataset>(data);
  write_alta(source, scratch / "x.alta", {});
  const Opened anisotropic = open_brdf(scratch / "x.alta");
  CHECK_FALSE(anisotropic.dataset->symmetry.isotropic);
  CHECK(std::fabs(anisotropic.dataset->angles[0].phi_i.degrees() - 20) < 1e-9);
  CHECK(test::faults_of([&] { write_alta_half(source, scratch / "no", {}); }).find("isotropic") != std::string::npos);
}

TEST_CASE("Every fault of a file is named at once") {
  const auto faults = [](const std::string& text) { return test::faults_of([&] { open(text); }); };
  const std::string header = faults("#DIM 1 0\n#VS 1\n#FORMAT binary\n#PARAM_IN COS_TK\n#PARAM_OUT HSV_COLOR\n0.9 1\n");
  for (const char* word : {"'COS_TK'", "'HSV_COLOR'", "VS '1'", "'binary'", "DIM '1 0'"}) {
    INFO(word << " in " << header);
    CHECK(header.find(word) != std::string::npos);
  }
  const std::string rows = faults(projected + "0.5 0.5 0\n0.5 x 0 1\n0.5 0 0 inf\n");
  for (const char* word : {":6|3 numbers", ":7|", ":8|"}) {
    INFO(word << " in " << rows);
    CHECK(rows.find(word) != std::string::npos);
  }
  CHECK(faults(projected).find("no sample") != std::string::npos);
}

TEST_CASE("No damaged file of ALTA's does more than raise an error") {
  const test::TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \"#\r\nDIMPARAVS_nan") + std::string("\0\xff", 2);
  const std::string seed = projected + "0.5 0.5 0 2\n0.5 -0.5 0 3\n0.5 0 0.8 1\n0.5 0 0 4\n";
  const auto [read, refused] = test::read_damaged({seed}, letters, 20260705, 4000, [&](const std::string& text) {
    const Dataset data = read_alta(scratch.file("damaged.dat", text), {});
    data.require_consistent();
    REQUIRE(data.size() > 0);
  });
  CHECK(read > 200);
  CHECK(refused > 500);
}
