// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_wavelengths.hpp"

#include <cmath>

#include "tabulated/formats/csv.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

const std::string head = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,wavelength_um,value,u_value\n";

Dataset read(const std::string& text, const ReadOptions& options = {}) {
  const test::TemporaryFolder scratch;
  return read_csv(scratch.file("file.csv", text), options);
}

}  // namespace

TEST_CASE("Rows of several wavelengths become one channel each, unknown where a direction was not measured") {
  const Dataset data = read(head + "30,0,40,180,0.532,.5,.01\n30,0,50,180,0.532,.4,.01\n30,0,40,180,0.351,.3,.02\n");
  REQUIRE(data.channels.size() == 2);
  CHECK(data.channels[0].name == "351nm");
  CHECK(data.channels[0].wavelength_in_nm == 351.0);
  CHECK(data.channels[1].wavelength_out_nm == 532.0);
  REQUIRE(data.size() == 2);
  CHECK(data.f[0][0] == .3);
  CHECK(data.f[1][0] == .5);
  CHECK(std::isnan(data.f[0][1]));
  CHECK(data.f[1][1] == .4);
  CHECK(data.u[0][0] == .02);
  CHECK(std::isnan(data.u[0][1]));
  data.require_consistent();
}

TEST_CASE("Repeats at one direction and wavelength stay samples of their own") {
  const Dataset data = read(head + "30,0,40,180,0.5,1,.1\n30,0,40,180,0.5,2,.1\n30,0,40,180,0.6,3,.1\n");
  REQUIRE(data.size() == 2);
  CHECK(data.f[0] == std::vector<double>{1, 2});
  CHECK(data.f[1][0] == 3);
  CHECK(std::isnan(data.f[1][1]));
}

TEST_CASE("A column of wavelengths with several channels, optional columns or a blank is refused") {
  const std::string poses = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,wavelength_nm,";
  const auto faults = [](const std::string& text, const ReadOptions& options = {}) {
    return test::faults_of([&] { read(text, options); });
  };
  CHECK(faults(poses + "a,b\n30,0,40,180,500,1,2\n").find("2 channels") != std::string::npos);
  CHECK(faults(poses + "a,repeat\n30,0,40,180,500,1,2\n").find("optional columns") != std::string::npos);
  CHECK(faults(poses + "a\n30,0,40,180,-500,1\n").find("a wavelength of -500") != std::string::npos);
  CHECK(faults(poses + "wavelength_um,a\n30,0,40,180,500,.5,1\n").find("second source") != std::string::npos);
  const test::TemporaryFolder scratch;
  ReadOptions options;
  options.blank = scratch.file("blank.csv", poses + "a\n30,0,40,180,500,1\n");
  CHECK(faults(poses + "a\n30,0,40,180,500,1\n", options).find("a blank holds at one wavelength") != std::string::npos);
}

TEST_CASE("What a foreign file's columns were not used for is said") {
  ReadOptions options;
  options.columns = {{"theta_i_deg", "1"}, {"phi_i_deg", "2"}, {"theta_o_deg", "3"}, {"phi_o_deg", "4"}, {"value", "5"}};
  CHECK(read("a,b,c,d,e,m12,m13\n30,0,40,180,.5,0,0\n", options).provenance.at("columns_left_out") == "m12, m13");
  CHECK(read("30,0,40,180,.5,0\n", options).provenance.at("columns_left_out") == "column 6");
  CHECK_FALSE(read(head + "30,0,40,180,0.5,1,.1\n").provenance.contains("columns_left_out"));
}
