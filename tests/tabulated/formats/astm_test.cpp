// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/astm.hpp"

#include <cmath>
#include <random>

#include "tabulated/opened_samples.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::replaced;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

const std::string small =
    "A sample\nNUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n0.5,0,0.25,3,0.1,0.2,0.3\n0.5,0,-0.25,3,0.4,0.5,0.6\n";

Dataset read(const std::string& text, const std::string& specular = "pi") {
  const TemporaryFolder scratch;
  ReadOptions options;
  if (!specular.empty()) options.assume["specular"] = specular;
  const Opened opened = open_brdf(scratch.file("file.astm", text), options);
  CHECK(opened.format == "astm");
  return *opened.dataset;
}

}  // namespace

TEST_CASE("Where specular is has to be said; a negative zenith angle is across the normal") {
  CHECK(faults_of([&] { read(small, ""); }).find("--assume specular=0") != std::string::npos);
  const Dataset pi = read(small);
  CHECK(pi.channels == rgb_channels());
  CHECK(pi.angles[0].phi_o.radians() == 3);
  CHECK(std::fabs(std::remainder(pi.angles[1].phi_o.degrees() - pi.angles[0].phi_o.degrees(), 360)) == 180);
  CHECK(pi.f[2] == std::vector<double>{0.3, 0.6});
  CHECK(pi.provenance.at("header") == "A sample");
  const Dataset standard = read(small, "0");
  CHECK(std::fabs(std::remainder(standard.angles[0].phi_o.degrees() - pi.angles[0].phi_o.degrees(), 360)) == 180);
}

TEST_CASE("Wavelengths and tristimulus values are channels") {
  CHECK(read(replaced(small, "R,G,B", "X,Y,Z")).channels[1].name == "Y");
  const Dataset spectral = read(replaced(small, "R,G,B", "400nm,500nm,600nm"));
  CHECK(spectral.channels[2].wavelength_in_nm == 600);
}

TEST_CASE("Samples written as ASTM read back as they were, transmission too") {
  const TemporaryFolder scratch;
  Dataset samples;
  samples.channels = {single_channel("450nm").front(), single_channel("650nm").front()};
  samples.side = Side::transmission;
  samples.angles = {{10_deg, 0_deg, 170_deg, 180_deg}, {30_deg, -90_deg, 120_deg, 400_deg}};
  samples.f = {{1.25, -0.5}, {2.0 / 3, std::nan("")}};
  const ExportNotes notes = write_astm(opened_samples("csv", std::make_shared<const Dataset>(samples)), scratch / "a.astm", {});
  CHECK(notes.n_nodes == 2);
  const Opened back = open_brdf(scratch / "a.astm");
  CHECK(back.dataset->side == Side::transmission);
  CHECK(back.dataset->channels[1].wavelength_in_nm == 650);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(angle_between(back.dataset->angles[k].wi(), samples.angles[k].wi()).radians() < 1e-12);
    CHECK(angle_between(back.dataset->angles[k].wo(), samples.angles[k].wo()).radians() < 1e-12);
    CHECK(back.dataset->f[0][k] == samples.f[0][k]);
  }
  CHECK(std::isnan(back.dataset->f[1][1]));
}

TEST_CASE("A model is sampled, and the file says where specular is") {
  const TemporaryFolder scratch;
  const Opened model = test::source_of_model("phong", rgb_channels(), {{0.3, 0.2, 20}, {0.2, 0.2, 20}, {0.1, 0.2, 20}});
  write_astm(model, scratch / "a.astm", {});
  const Opened back = open_brdf(scratch / "a.astm");
  CHECK(back.dataset->channels == rgb_channels());
  for (std::size_t k = 0; k < back.dataset->size(); k += 7) {
    const GonioAngles& pose = back.dataset->angles[k];
    const std::vector<double> exact = model.brdf->eval(pose.wi(), pose.wo());
    for (std::size_t c = 0; c < 3; ++c) REQUIRE(std::fabs(back.dataset->f[c][k] - exact[c]) < 1e-9);
  }
}

TEST_CASE("The faults of an ASTM file are named, all at once") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { read(replaced(small, what, by)); }); };
  CHECK(faults("NUM_POINTS 2", "NUM_POINTS 3").find("3, as NUM_POINTS says") != std::string::npos);
  CHECK(faults("NUM_POINTS 2", "NUM_POINTS x").find("'NUM_POINTS x'") != std::string::npos);
  CHECK(faults("R,G,B", "R,R,B").find("'R'") != std::string::npos);
  CHECK(faults("0.1,0.2,0.3", "0.1,0.2").find(":4|6 numbers") != std::string::npos);
  CHECK(faults("0.1,0.2,0.3", "0.1,inf,0.3").find("'inf'") != std::string::npos);
  CHECK(faults("phi_s,R,G,B", "phi_s").find("VARS theta_i,phi_i,theta_s,phi_s and") != std::string::npos);
  const std::string two = faults_of([&] { read(replaced(replaced(small, "0.3\n", "x\n"), "0.6\n", "y\n")); });
  CHECK((two.find("'x'") != std::string::npos && two.find("'y'") != std::string::npos));
}

TEST_CASE("No damaged ASTM file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE,\t \r\nVARSNUM_") + std::string("\0\xff", 2);
  ReadOptions options;
  options.assume["specular"] = "pi";
  const auto [read_count, refused] = test::read_damaged({small}, letters, 20260717, 4000, [&](const std::string& bytes) {
    read_astm(scratch.file("damaged", bytes), options).require_consistent();
  });
  CHECK(read_count > 200);
  CHECK(refused > 500);
}
