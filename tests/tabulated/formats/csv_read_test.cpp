// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv.hpp"

#include <cmath>
#include <numbers>

#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

constexpr double rounding_only = 1e-15;  // one multiplication or division away from the text

const std::string head = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";

Dataset read(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder scratch;
  return read_csv(scratch.file("file.csv", text), options);
}

std::string refusal(const std::string& text, const ReadOptions& options = {}) {
  return faults_of([&] { read(text, options); });
}

}  // namespace

TEST_CASE("A header names the columns, in any order and with any separator") {
  for (const std::string separator : {",", ";", "\t", "   ", " , "}) {
    std::string text = "phi_o_deg,value,theta_i_deg,theta_o_deg,phi_i_deg\n180,0.25,30,40,10\n";
    for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += separator.size()) text.replace(at, 1, separator);
    const Dataset data = read(text);
    REQUIRE(data.size() == 1);
    CHECK(data.angles[0].theta_i.degrees() == 30);
    CHECK(data.angles[0].phi_i.degrees() == 10);
    CHECK(data.angles[0].theta_o.degrees() == 40);
    CHECK(data.angles[0].phi_o.degrees() == 180);
    CHECK(data.f[0][0] == 0.25);
    CHECK(data.channels[0].name == "value");
    CHECK_FALSE(data.has_uncertainty());
  }
}

TEST_CASE("Channels, uncertainties and the optional columns are told apart by their names") {
  const Dataset data = read(
      "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,u_r,550nm,repeat,time_s,c_scale,measured_theta_o_deg\n"
      "30,0,40,180,.5,.01,.25,1,12.5,1,40.001\n");
  REQUIRE(data.channels.size() == 2);
  CHECK(data.channels[0].name == "r");
  CHECK(data.channels[1].name == "550nm");
  CHECK(data.u[0][0] == .01);
  CHECK(std::isnan(data.u[1][0]));
  CHECK(data.extra.at("repeat")[0] == 1);
  CHECK(data.extra.at("time_s")[0] == 12.5);
  CHECK(data.extra.at("c_scale")[0] == 1);
  CHECK(data.extra.at("measured_theta_o_deg")[0] == 40.001);
}

TEST_CASE("Columns are mapped by position or by name, and constants fill in what is not there") {
  ReadOptions options;
  options.columns = {{"theta_i_deg", "2"}, {"theta_o_deg", "3"}, {"phi_o_deg", "1"}, {"value", "4"}};
  options.set = {{"phi_i_deg", 90}, {"u_value", 0.5}};
  const Dataset by_position = read("-90 10 20 0.5\n", options);
  CHECK(by_position.angles[0].theta_i.degrees() == 10);
  CHECK(by_position.angles[0].phi_i.degrees() == 90);
  CHECK(by_position.angles[0].theta_o.degrees() == 20);
  CHECK(by_position.angles[0].phi_o.degrees() == -90);
  CHECK(by_position.u[0][0] == 0.5);

  // Columns that are neither mapped nor reserved are left out, text in them too.
  options.columns = {{"theta_i_deg", "incidence"}, {"theta_o_deg", "receive"}, {"phi_o_deg", "azimuth"}, {"value", "RT"}};
  const Dataset by_name = read("sheet,azimuth,incidence,receive,RT,other\nSheet1,-90,10,20,0.5,x\n", options);
  REQUIRE(by_name.channels.size() == 1);
  CHECK(by_name.f[0][0] == 0.5);
  CHECK(by_name.angles[0].theta_o.degrees() == 20);
}

TEST_CASE("Angles may come in radians") {
  ReadOptions options;
  options.columns = {{"theta_i_rad", "1"}, {"phi_i_rad", "2"}, {"theta_o_rad", "3"}, {"phi_o_deg", "4"}, {"value", "5"}};
  const Dataset data = read("0.5 0.25 1.5707963267948966 180 1\n", options);
  CHECK(data.angles[0].theta_i.radians() == 0.5);
  CHECK_FALSE(data.angles[0].theta_i.made_from_degrees());
  CHECK(data.angles[0].phi_o.degrees() == 180);
}

TEST_CASE("A negative zenith angle is the opposite azimuth") {
  const Dataset data = read(head + "30,0,-40,0,1\n-30,10,40,200,2\n");
  CHECK(data.angles[0].theta_o.degrees() == 40);
  CHECK(data.angles[0].phi_o.degrees() == 180);
  CHECK(data.angles[1].theta_i.degrees() == 30);
  CHECK(data.angles[1].phi_i.degrees() == 190);
}

TEST_CASE("A file in one plane needs to be told which side is specular") {
  const std::string text = "theta_i_deg theta_o_deg value\n30 30 1\n30 -30 2\n";
  CHECK(refusal(text).find("--in-plane") != std::string::npos);
  ReadOptions options;
  options.in_plane = InPlane::specular_positive;
  Dataset data = read(text, options);
  CHECK(angle_between(data.angles[0].wo(), Direction::spherical(30_deg, 180_deg)).radians() < rounding_only);
  CHECK(angle_between(data.angles[1].wo(), Direction::spherical(30_deg, 0_deg)).radians() < rounding_only);
  options.in_plane = InPlane::specular_negative;
  data = read(text, options);
  CHECK(angle_between(data.angles[0].wo(), Direction::spherical(30_deg, 0_deg)).radians() < rounding_only);
  CHECK(angle_between(data.angles[1].wo(), Direction::spherical(30_deg, 180_deg)).radians() < rounding_only);
  CHECK(refusal(head + "30,0,30,180,1\n", options).find("in-plane") != std::string::npos);
}

TEST_CASE("What is not a measurement is masked and counted") {
  const Dataset data = read(
      "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,g\n"
      "30,0,40,180,,\n"          // empty
      "30,0,40,180,nan,NA\n"     //
      "nan,0,40,180,1,1\n"       // no direction
      "30,0,40,180,-1,-1\n"      // missing
      "30,0,90.5,180,1,1\n"      // below the horizon
      "-91,0,40,180,1,1\n"       //
      "30,0,90,180,1,1\n"        // kept: 90 degrees exactly
      "30,0,-90,180,1,1\n"       //
      "30,0,40,180,-1,0.5\n"     // kept: only one channel is -1
      "30,0,40,180,-0.001,-2\n"  // kept: other negatives
      "30,0,40,180,nan,1\n");    // kept: one channel has a value
  CHECK(data.masked.nan == 3);
  CHECK(data.masked.missing == 1);
  CHECK(data.masked.below_horizon == 2);
  CHECK(data.size() == 5);
  CHECK(std::isnan(data.f[0][4]));
  CHECK(data.f[1][3] == -2);

  ReadOptions options;
  options.missing = -999;
  CHECK(read(head + "30,0,40,180,-999\n30,0,40,180,-1\n", options).masked.missing == 1);
  options.missing = std::nullopt;
  CHECK(read(head + "30,0,40,180,-1\n", options).size() == 1);
}

TEST_CASE("Every quantity becomes f on entry, and its uncertainty with it") {
  const std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,60,180,0.5,0.01\n30,0,90,180,0.5,0.01\n";
  const auto check = [&](Quantity quantity, double factor, std::size_t kept) {
    ReadOptions options;
    options.quantity = quantity;
    const Dataset data = read(text, options);
    CHECK(data.size() == kept);
    CHECK(data.masked.nan == 2 - kept);
    CHECK(data.f[0][0] == Approx(0.5 * factor).epsilon(rounding_only));
    CHECK(data.u[0][0] == Approx(0.01 * factor).epsilon(rounding_only));
    CHECK(data.channels[0].quantity == Quantity::f);
  };
  check(Quantity::f, 1, 2);
  check(Quantity::reflectance_factor, 1 / std::numbers::pi, 2);
  check(Quantity::f_cos, 2, 1);  // at 90 degrees f cos theta_o says nothing about f
  check(Quantity::signal_ratio, 2 / std::numbers::pi, 1);
}

TEST_CASE("A blank is subtracted at equal directions before conversion") {
  const TemporaryFolder scratch;
  ReadOptions options;
  options.quantity = Quantity::reflectance_factor;
  options.blank = scratch.file(
      "blank.csv",
      "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,50,180,.2,.03\n30,0,40,180,.1,.04\n30,0,40,180,.3,.04\n");
  const auto sample =
      scratch.file("sample.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,40,180,.5,.02\n30,0,50,180,.7,.04\n");
  const Dataset data = read_csv(sample, options);
  CHECK(data.f[0][0] == Approx(0.3 / std::numbers::pi).epsilon(rounding_only));  // mean of the two blanks: .2
  CHECK(data.f[0][1] == Approx(0.5 / std::numbers::pi).epsilon(rounding_only));
  CHECK(data.u[0][0] == Approx(std::sqrt(.02 * .02 + .04 * .04 / 2) / std::numbers::pi).epsilon(rounding_only));
  CHECK(data.u[0][1] == Approx(.05 / std::numbers::pi).epsilon(rounding_only));

  options.blank = scratch.file("short.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,50,180,.2,.03\n");
  const std::string refused = faults_of([&] { read_csv(sample, options); });
  CHECK(refused.find("short.csv|no reading at (30, 0, 40, 180)") != std::string::npos);
}

TEST_CASE("All faults of a file come at once, each with its line") {
  const std::string refused = refusal(head +
                                      "30,0,40,180,1\n"
                                      "30,0,40,180,bright\n"
                                      "30,0,40,180\n"
                                      "30,0,inf,180,1\n"
                                      "30,0,40,180,1,1\n");
  CHECK(refused.find("input|") == 0);
  CHECK(refused.find("file.csv:3|text 'bright' in column 5|") != std::string::npos);
  CHECK(refused.find("file.csv:4|4 columns|5, as in the first row") != std::string::npos);
  CHECK(refused.find("file.csv:5|an infinity 'inf' in column 3|") != std::string::npos);
  CHECK(refused.find("file.csv:6|6 columns|") != std::string::npos);
  CHECK(refused.find("file.csv:2") == std::string::npos);
}

TEST_CASE("Many faults are shown in part and counted in full") {
  std::string text = head;
  for (int k = 0; k < 1000; ++k) text += "30,0,40,180,x\n";
  const std::string refused = refusal(text);
  CHECK(refused.find(": 980 more faults") != std::string::npos);
  CHECK(refused.size() < 4000);
}

TEST_CASE("An uncertainty of zero or below is a fault, an unknown one is not") {
  const std::string with_u = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  CHECK(refusal(with_u + "30,0,40,180,1,0\n").find("file.csv:2|a standard uncertainty of 0|") != std::string::npos);
  CHECK(refusal(with_u + "30,0,40,180,1,-1\n").find("file.csv:2|") != std::string::npos);
  CHECK(std::isnan(read(with_u + "30,0,40,180,1,nan\n").u[0][0]));
  CHECK(read(with_u + "30,0,40,180,-1,-1\n30,0,40,180,1,1\n").size() == 1);  // the u of a masked row is not looked at
}

TEST_CASE("Missing, unknown and doubled columns are refused by name") {
  CHECK(refusal("30,0,40,180,1\n").find("no column theta_i_deg") != std::string::npos);
  CHECK(refusal("theta_i_deg,phi_i_deg,theta_o_deg,value\n1,2,3,4\n").find("no column phi_o_deg") != std::string::npos);
  CHECK(refusal("theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg\n1,2,3,4\n").find("no column of values") != std::string::npos);
  CHECK(refusal("theta_i_deg,theta_i_rad,phi_i_deg,theta_o_deg,phi_o_deg,value\n1,1,2,3,4,5\n").find("a second source of theta_i_rad") !=
        std::string::npos);
  ReadOptions options;
  options.columns = {{"theta_i_deg", "incidence"}, {"value", "9"}};
  const std::string refused = refusal(head + "1,2,3,4,5\n", options);
  CHECK(refused.find("--columns theta_i_deg=incidence|no such column") != std::string::npos);
  CHECK(refused.find("--columns value=9|no such column") != std::string::npos);
  options.columns.clear();
  options.set = {{"theta_i_deg", 3}, {"colour", 1}};
  const std::string constants = refusal(head + "1,2,3,4,5\n", options);
  CHECK(constants.find("--set theta_i_deg|a second source") != std::string::npos);
  CHECK(constants.find("--set colour|") != std::string::npos);
}

TEST_CASE("A file without a single sample is refused with what became of its rows") {
  CHECK(refusal("").find("no row") != std::string::npos);
  CHECK(refusal("# nothing\n\n").find("no row") != std::string::npos);
  CHECK(refusal(head).find("no sample in 0 rows") != std::string::npos);
  CHECK(refusal(head + "30,0,40,180,nan\n30,0,40,180,-1\n").find("no sample in 2 rows (1 nan, 1 missing, 0 below horizon)") !=
        std::string::npos);
}

TEST_CASE("Byte order mark, CR LF, comments and a missing last line end are read; NUL bytes and huge fields are refused") {
  CHECK(read("\xEF\xBB\xBF# a comment\r\n" + head + "30,0,40,180,1 # at last\r\n\r\n30,0,50,180,2").size() == 2);
  CHECK(refusal(head + std::string("30,0,40,180,1\0\n", 15)).find("text '1\\x00'") != std::string::npos);
  const std::string refused = refusal(head + "30,0,40,180," + std::string(1 << 20, '7') + "x\n");
  CHECK(refused.find("file.csv:2|text '7777") != std::string::npos);
  CHECK(refused.size() < 400);
}
