// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/alta.hpp"

#include <cmath>
#include <random>

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

TEST_CASE("Every fault of a file is named at once") {
  const auto faults = [](const std::string& text) { return test::faults_of([&] { open(text); }); };
  const std::string header = faults("#DIM 1 0\n#VS 1\n#FORMAT binary\n#PARAM_IN COS_TH\n#PARAM_OUT RGB_COLOR\n0.9 1\n");
  for (const char* word : {"'COS_TH'", "'RGB_COLOR'", "VS '1'", "'binary'", "DIM '1 0'"}) {
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
  std::mt19937 random(20260705);
  const std::string letters = std::string("0123456789.-+eE\t \"#\r\nDIMPARAVS_nan") + std::string("\0\xff", 2);
  const std::string seed = projected + "0.5 0.5 0 2\n0.5 -0.5 0 3\n0.5 0 0.8 1\n0.5 0 0 4\n";
  int read = 0, refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::string text = test::damaged(seed, letters, random);
    INFO("round " << round << " of seed 20260705");
    try {
      const Dataset data = read_alta(scratch.file("damaged.dat", text), {});
      data.require_consistent();
      REQUIRE(data.size() > 0);
      ++read;
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::input);
      ++refused;
    }
  }
  CHECK(read > 200);
  CHECK(refused > 500);
}
