// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/cornell.hpp"

#include <cmath>
#include <random>

#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::replaced;
using gonio::test::TemporaryFolder;

namespace {

const std::string small =
    "# A paint\n\n# num wls\n2\n\n# wls\n400\n500\n\n# theta i, phi i, theta s, phi_s, spectral sample values\n\n0.5 0 0.25 3.141593 0.1 "
    "0.2\n0.5 0 0.25 0 "
    "0.3 0.4\n";

Dataset read(const std::string& text) {
  const TemporaryFolder scratch;
  return read_cornell(scratch.file("file.brdf", text), {});
}

}  // namespace

TEST_CASE("Cornell's samples are in radians, one channel per wavelength") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("file.brdf", small));
  CHECK(opened.format == "cornell");
  CHECK(opened.dataset->size() == 2);
  CHECK(opened.dataset->channels[1].wavelength_in_nm == 500);
  CHECK(opened.dataset->f[1] == std::vector<double>{0.2, 0.4});
  CHECK(opened.dataset->angles[0].theta_o.radians() == 0.25);
  CHECK(opened.dataset->provenance.at("comments") == "A paint");
}

TEST_CASE("The paints of Cornell read as 1439 samples of 31 wavelengths, specular at pi") {
  for (const std::string name : {"garnet_red", "krylon_blue", "mystique"}) {
    const auto path = test::measured_data("cornell/" + name + ".brdf");
    if (!path) return;
    const Opened opened = open_brdf(*path);
    CHECK(opened.format == "cornell");
    CHECK(opened.dataset->size() == 1439);
    CHECK(opened.dataset->channels.size() == 31);
    // At grazing incidence the largest value of gloss paints is on the specular side.
    std::size_t brightest = 0;
    for (std::size_t k = 0; k < opened.dataset->size(); ++k)
      if (opened.dataset->f[15][k] > opened.dataset->f[15][brightest]) brightest = k;
    const GonioAngles& pose = opened.dataset->angles[brightest];
    INFO(name << " brightest at " << pose.theta_i.degrees() << " " << pose.theta_o.degrees() << " " << pose.phi_o.degrees());
    CHECK(std::fabs(std::remainder(pose.phi_o.degrees() - pose.phi_i.degrees() - 180, 360.0)) < 1);
  }
}

TEST_CASE("The faults of a Cornell file are named") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { read(replaced(small, what, by)); }); };
  CHECK(faults("400\n500", "500\n400").find("wavelength 400") != std::string::npos);
  CHECK(faults("0.3 0.4", "0.3").find("the end of the file") != std::string::npos);
  CHECK(faults("0.3 0.4", "0.3 x").find("'x'") != std::string::npos);
  CHECK(faults("wls\n2", "wls\n200000").find("200000 wavelengths") != std::string::npos);
  CHECK(faults("0.5 0 0.25 0 ", "0.5 0 2.5 0 ").find("theta 0.5 and 2.5") != std::string::npos);
}

TEST_CASE("No damaged Cornell file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n#") + std::string("\0\xff", 2);
  const auto [read_count, refused] = test::read_damaged({small}, letters, 20260716, 4000, [&](const std::string& bytes) {
    read_cornell(scratch.file("damaged", bytes), {}).require_consistent();
  });
  CHECK(read_count > 200);
  CHECK(refused > 500);
}
