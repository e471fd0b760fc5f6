// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/speos.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tabulated/polar_integral.hpp"
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

const std::string table = "2\t3\n\t0\t180\t360\n0\t1\t1\t1\n60\t4\t2\t4\n";
const std::string isotropic =
    "OPTIS - brdf surface file v9.0\n0\na comment\n5\n-----\n1\t0\n1\n2\t1\n10\t30\n550\n12\n" + table + "12\n" + table + "End of file\n";
const std::string anisotropic =
    "OPTIS - Anisotropic BSDF surface file v8.0\n0\nComment\n4\ntext\n0\t1\t0\n0\t1\n0\n2\n0 90\n1\n15\n1\n15\n15.0\t0\nTransmission "
    "spectrum\n2\n350\t13\n850\t14\n"
    "2 2\n\t0\t180\n120\t1\t2\n180\t3\t3\n2 2\n\t0\t180\n120\t1\t2\n180\t3\t3\nEnd of file\n";

Dataset read(const std::string& text, const std::string& key = "scale", const std::string& answer = "stored") {
  const TemporaryFolder scratch;
  ReadOptions options;
  if (!key.empty()) options.assume[key] = answer;
  const Opened opened = open_brdf(scratch.file("file.brdf", text), options);
  CHECK(opened.format == "speos");
  return *opened.dataset;
}

}  // namespace

TEST_CASE("The integral of a constant table is that of a cap of the hemisphere") {
  std::vector<double> theta;
  for (int t = 0; t <= 60; ++t) theta.push_back(t);
  const std::vector<double> turn{0, 90, 180, 270, 360}, open_turn{0, 90, 180, 270}, one{0};
  const double exact = std::numbers::pi * 0.75;
  CHECK(std::fabs(polar_integral(theta, turn, std::vector<double>(61 * 5, 1.0)) / exact - 1) < 1e-3);
  CHECK(std::fabs(polar_integral(theta, open_turn, std::vector<double>(61 * 4, 1.0)) / exact - 1) < 1e-3);
  CHECK(std::fabs(polar_integral(theta, one, std::vector<double>(61, 1.0)) / exact - 1) < 1e-3);
}

TEST_CASE("Azimuth 0 is the specular side, the normal and the end of the turn are one sample each") {
  const Dataset data = read(isotropic);
  REQUIRE(data.size() == 2 * 3);
  CHECK(data.channels[0].wavelength_in_nm == 550);
  CHECK(data.f[0] == std::vector<double>{1, 4, 2, 1, 4, 2});
  CHECK(std::fabs(std::remainder(data.angles[1].phi_o.degrees() - data.angles[1].phi_i.degrees() - 180, 360)) < 1e-12);
  CHECK(data.provenance.at("comment") == "a comment");
}

TEST_CASE("A percentage that is not the integral of its table has to be explained, and scales it if that is said") {
  CHECK(faults_of([&] { read(isotropic, ""); }).find("--assume scale=stored") != std::string::npos);
  const std::vector<double> theta{0, 60}, phi{0, 180, 360}, f{1, 1, 1, 4, 2, 4};
  const double integral = polar_integral(theta, phi, f);
  const Dataset scaled = read(isotropic, "scale", "percentage");
  CHECK(std::fabs(scaled.f[0][1] - 4 * 0.12 / integral) < 1e-12);
}

TEST_CASE("Intensity becomes f; several anisotropy angles ask how they turn; transmission is below the horizon") {
  CHECK(faults_of([&] { read(anisotropic); }).find("--assume rotation=counter-clockwise") != std::string::npos);
  const Dataset data = read(anisotropic, "rotation", "clockwise");
  CHECK(data.side == Side::transmission);
  CHECK_FALSE(data.symmetry.isotropic);
  REQUIRE(data.size() == 2 * 3);
  CHECK(std::fabs(data.f[0][1] - 4) < 1e-12);  // 2 / cos 60
  CHECK(data.angles[0].phi_i.degrees() == 180);
  CHECK(data.angles[5].phi_i.degrees() == 90);
  CHECK(data.angles[0].theta_o.degrees() == 120);
  CHECK(data.provenance.at("speos_spectrum").find("350 13 850 14") != std::string::npos);
}

TEST_CASE("A model written for SPEOS reads back without a question; written again it is the same") {
  const TemporaryFolder scratch;
  WriteOptions paper;
  paper.size = GridSize::paper;
  const Opened model = test::source_of_model("phong", single_channel("value"), {{0.3, 0.2, 20}});
  const ExportNotes notes = write_speos(model, scratch / "a.brdf", paper);
  CHECK(notes.lost.back().find("untested") == 0);
  const Opened back = open_brdf(scratch / "a.brdf");
  CHECK(back.dataset->channels.size() == 2);
  for (std::size_t k = 0; k < back.dataset->size(); ++k) {
    const GonioAngles& pose = back.dataset->angles[k];
    const double exact = model.brdf->eval(pose.wi(), pose.wo())[0];
    REQUIRE(std::fabs(back.dataset->f[1][k] - exact) <= 1e-6 * exact);
  }
  write_speos(back, scratch / "b.brdf", {});
  CHECK(read_speos(scratch / "b.brdf", {}).f == back.dataset->f);
  CHECK(faults_of([&] {
          write_speos(test::source_of_model("ward-anisotropic", single_channel("value"), {{0, 1, 0.1, 0.3}}), scratch / "c", {});
        }).find("anisotropic") != std::string::npos);
}

TEST_CASE("The faults of a SPEOS file are named") {
  const auto faults = [](const std::string& what, const std::string& by) {
    return faults_of([&] { read(replaced(isotropic, what, by)); });
  };
  CHECK(faults("v9.0\n0", "v9.0\n1").find("mode '1'") != std::string::npos);
  CHECK(faults("v9.0", "v7.0").find("version 8 or 9") != std::string::npos);
  CHECK(faults("\n5\n", "\n5000\n").find("'5000'") != std::string::npos);
  CHECK(faults("10\t30", "30\t10").find("incidence 10 after 30") != std::string::npos);
  CHECK(faults("60\t4\t2\t4\n12", "60\t4\tx\t4\n12").find("'x'") != std::string::npos);
  CHECK(faults("2\t3\n", "2\t300000\n").find("300000 azimuths") != std::string::npos);
  CHECK(faults("1\t0\n1\n", "1\t2\n1\n").find("flag of transmission 2") != std::string::npos);
  CHECK(faults("End of file", "more").find("'more'") != std::string::npos);
  CHECK(faults("1\t0\n1\n", "0\t0\n1\n").find("'12'") != std::string::npos);
}

TEST_CASE("No damaged SPEOS file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n") + std::string("\0\xff", 2);
  ReadOptions options;
  options.assume = {{"scale", "stored"}, {"rotation", "clockwise"}};
  const auto [read_count, refused] = test::read_damaged({isotropic, anisotropic}, letters, 20260718, 5000, [&](const std::string& bytes) {
    read_speos(scratch.file("damaged", bytes), options).require_consistent();
  });
  CHECK(read_count > 50);
  CHECK(refused > 500);
}
