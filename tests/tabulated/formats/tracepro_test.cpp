// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/tracepro.hpp"

#include <cmath>
#include <random>

#include "tests/random_directions.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::replaced;
using gonio::test::TemporaryFolder;

namespace {

const std::string small =
    "TracePro Surface Property "
    "Data\nDescription\n\nTable_BSDF_Data\nTemperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF\n"
    "300\t0.55\t30\t0\t0\t0\t5\t0\t\n300\t0.55\t30\t0\t0\t90\t5\t0\t\n300\t0.55\t30\t0\t0.25\t0\t1\t0\t\n300\t0.55\t30\t0\t0."
    "25\t90\t2\t0\t\n300\t0.55\t30\t0\t0.75\t90\t0\t0\t\n";

Dataset read(const std::string& text, const std::string& zero = "across") {
  const TemporaryFolder scratch;
  ReadOptions options;
  if (!zero.empty()) options.assume["zero_azimuth"] = zero;
  const Opened opened = open_brdf(scratch.file("file.txt", text), options);
  CHECK(opened.format == "tracepro");
  return *opened.dataset;
}

}  // namespace

TEST_CASE("Scatter is told by beta - beta0; where its azimuth counts from has to be said; beyond the horizon is masked") {
  CHECK(faults_of([&] { read(small, ""); }).find("--assume zero_azimuth=across") != std::string::npos);
  const Dataset data = read(small);
  REQUIRE(data.size() == 3);
  CHECK(data.masked.below_horizon == 1);
  CHECK(data.symmetry.isotropic);
  CHECK(data.channels[0].wavelength_in_nm == 550);
  CHECK(std::fabs(data.angles[0].theta_o.degrees() - 30) < 1e-12);
  CHECK(std::fabs(std::remainder(data.angles[0].phi_o.degrees() - 180, 360)) < 1e-12);
  CHECK(std::fabs(data.angles[2].theta_o.sin() - 0.75) < 1e-12);  // forward of specular
  const Dataset fixed = read(small, "fixed");
  CHECK(std::fabs(fixed.angles[1].theta_o.sin() - 0.25) < 1e-12);  // +x is back towards the light
  CHECK_FALSE(fixed.symmetry.isotropic);
}

TEST_CASE("A table of one azimuth is one of rings and needs no answer; both kinds of scatter do") {
  const std::string rings =
      "TracePro Surface Property Data\nTable_BSDF_Data\nnames\n300 0.55 10 0 0 0 3 0\n300 0.55 10 0 0.1 0 2 0\n300 0.65 10 0 0 0 4 0\n300 "
      "0.65 10 0 0.1 0 1 0\n";
  const Dataset data = read(rings, "");
  CHECK(data.size() == 1 + 12);
  CHECK(data.channels.size() == 2);
  CHECK(data.symmetry.bilateral);
  CHECK(faults_of([&] { read(replaced(rings, "3 0", "3 1"), ""); }).find("--assume scatter=BRDF") != std::string::npos);
}

TEST_CASE("A model written for TracePro reads back without a question, transmission apart from reflection") {
  const TemporaryFolder scratch;
  WriteOptions paper;
  paper.size = GridSize::paper;
  const Opened model = test::source_of_model("phong", single_channel("value"), {{0.3, 0.2, 20}});
  const ExportNotes notes = write_tracepro(model, scratch / "a.txt", paper);
  CHECK(notes.lost.front().find("untested") == 0);
  const Opened back = open_brdf(scratch / "a.txt");
  CHECK(back.format == "tracepro");
  CHECK(back.masked.below_horizon == notes.n_below_horizon);
  for (std::size_t k = 0; k < back.dataset->size(); ++k) {
    const GonioAngles& pose = back.dataset->angles[k];
    if (pose.theta_o.cos() < 0.01) continue;  // the last digits of beta move grazing directions
    const double exact = model.brdf->eval(pose.wi(), pose.wo())[0];
    REQUIRE(std::fabs(back.dataset->f[0][k] - exact) <= 1e-5 * exact);
  }
}

TEST_CASE("A table is known everywhere within its incidences, up to the horizon; values that are nan are masked and left out") {
  const TemporaryFolder scratch;
  WriteOptions paper;
  paper.size = GridSize::paper;
  const Opened model = test::source_of_model("phong", single_channel("value"), {{0.3, 0.2, 20}});
  write_tracepro(model, scratch / "a.txt", paper);
  const Opened back = open_brdf(scratch / "a.txt");
  test::Random random(test::seed);
  double sum = 0;
  int compared = 0;
  for (int k = 0; k < 5000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double exact = model.brdf->eval(wi, wo)[0], read = back.brdf->eval(wi, wo)[0];
    REQUIRE(std::isfinite(read));
    if (wi.z() > 0.2 && wo.z() > 0.2) sum += std::fabs(read / exact - 1), ++compared;
  }
  CHECK(sum / compared < 0.08);  // twelve azimuths and steps of 47 per cent through a lobe that is 17 degrees wide

  const Dataset data = read(replaced(small, "0.25\t0\t1", "0.25\t0\tnan"));
  CHECK(data.size() == 2);
  CHECK(data.masked.nan == 1);
}

TEST_CASE("The faults of a TracePro file are named, all at once") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { read(replaced(small, what, by)); }); };
  CHECK(faults("0.25\t0\t1", "0.25\t0\tx").find(":8|'x'") != std::string::npos);
  CHECK(faults("0.25\t0\t1", "2.5\t0\t1").find("ScatterBeta 2.5") != std::string::npos);
  CHECK(faults("300\t0.55\t30\t0\t0.25\t0", "300\t0.55\t95\t0\t0.25\t0").find("incidence 95") != std::string::npos);
  CHECK(faults("300\t0.55\t30\t0\t0.25\t0", "300\t-1\t30\t0\t0.25\t0").find("wavelength -1") != std::string::npos);
  CHECK(faults("0.25\t0\t1\t0", "0.25\t0\t1").find("7 columns") != std::string::npos);
  CHECK(faults("0.25\t90\t2", "0.25\t0\t2").find("a second value") != std::string::npos);
  CHECK(faults("Table_BSDF_Data", "Other").find("no row") != std::string::npos);
}

TEST_CASE("No damaged TracePro file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\nTable") + std::string("\0\xff", 2);
  ReadOptions options;
  options.assume["zero_azimuth"] = "across";
  const auto [read_count, refused] = test::read_damaged({small}, letters, 20260719, 4000, [&](const std::string& bytes) {
    open_tracepro(scratch.file("damaged", bytes), options).dataset->require_consistent();
  });
  CHECK(read_count > 200);
  CHECK(refused > 500);
}
