// SPDX-License-Identifier: BSD-3-Clause
// Files of other laboratories, read as they are.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>

#include "tabulated/formats/csv.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::read_file;
using gonio::test::TemporaryFolder;

namespace {

const std::vector<std::pair<std::string, std::string>> five_columns{
    {"theta_i_deg", "1"}, {"phi_i_deg", "2"}, {"theta_o_deg", "3"}, {"phi_o_deg", "4"}, {"value", "5"}};

}  // namespace

TEST_CASE("NASA's airborne vegetation data read as 14500 samples") {
  const auto path = test::measured_data("lumos/vegetation_brdf_cars.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = five_columns;
  const Dataset data = read_csv(*path, options);
  CHECK(data.size() == 14500);
  CHECK(data.masked.total() == 0);
  CHECK(data.angles[0].theta_i.degrees() == 30.42);
  CHECK(data.angles[0].theta_o.degrees() == 64.5);
  CHECK(data.f[0][0] == 0.414445);
}

TEST_CASE("Scatterworks' in-plane data keep every sample, 90 degrees included") {
  const auto path = test::measured_data("lumos/chassis_brdf.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = five_columns;
  const Dataset data = read_csv(*path, options);
  CHECK(data.size() == 4 * 181);
  CHECK(data.masked.total() == 0);
  for (const GonioAngles& angles : data.angles) REQUIRE(angles.theta_o.degrees() >= 0);
}

TEST_CASE("The in-plane slice of MERL's aluminium reads") {
  const auto path = test::measured_data("lumos/merl_aluminium_inplane.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = five_columns;
  const Dataset data = read_csv(*path, options);
  CHECK(data.size() + data.masked.total() == 7 * 255);
}

TEST_CASE("The RT-300S black coating gives its published means after blank and conversion") {
  const auto path = test::measured_data("loft_rt300s/raw_csv/ANOPLATE_AnoBlack_EC1_Alum6061_v1o0_20251115.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = {{"phi_o_deg", "azimuth_deg"}, {"theta_i_deg", "incidence_deg"}, {"theta_o_deg", "receive_deg"}, {"value", "RT"}};
  options.set = {{"phi_i_deg", 90}};
  options.quantity = Quantity::signal_ratio;
  options.blank = test::measured_data("loft_rt300s/raw_csv/blank_v2o0_20250911.csv").value();
  const Dataset data = read_csv(*path, options);
  CHECK(data.size() == 2508);
  std::map<double, std::pair<double, int>> sums;
  for (std::size_t k = 0; k < data.size(); ++k)
    if (data.angles[k].theta_o.degrees() == 0) {
      sums[data.angles[k].theta_i.degrees()].first += data.f[0][k];
      ++sums[data.angles[k].theta_i.degrees()].second;
    }
  REQUIRE(sums.size() == 4);
  constexpr double printed_digits = 5e-6;
  for (const auto& [incidence, reference] : std::map<double, double>{{10, 0.03246}, {30, 0.02044}, {50, 0.01195}, {70, 0.00851}})
    CHECK(std::fabs(sums[incidence].first / sums[incidence].second - reference) <= printed_digits);
}

TEST_CASE("Cornell's paints read in radians once their preamble is cut off") {
  const auto path = test::measured_data("cornell/krylon_blue.brdf");
  if (!path) return;
  std::istringstream lines(read_file(*path));
  std::string rows;
  for (std::string line; std::getline(lines, line);)
    if (std::count(line.begin(), line.end(), '.') == 35) rows += line + "\n";
  const TemporaryFolder scratch;
  ReadOptions options;
  options.columns = {{"theta_i_rad", "1"}, {"phi_i_rad", "2"}, {"theta_o_rad", "3"}, {"phi_o_rad", "4"}};
  for (int k = 0; k < 31; ++k) options.columns.emplace_back(fmt::format("{}nm", 400 + 10 * k), std::to_string(5 + k));
  const Dataset data = read_csv(scratch.file("rows.csv", rows), options);
  CHECK(data.size() == 1439);
  CHECK(data.channels.size() == 31);
  CHECK(data.channels[15].name == "550nm");
}

TEST_CASE("NIST's PTFE reads with its header's names") {
  const auto path = test::measured_data("nist_ptfe/PTFE.data.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = {{"theta_i_deg", "thetai"}, {"phi_i_deg", "phi"}, {"theta_o_deg", "thetar"}, {"phi_o_deg", "phir"}, {"value", "f_r11"}};
  const Dataset data = read_csv(*path, options);
  CHECK(data.size() == 4 * 1824);
  CHECK(data.angles[0].theta_i.degrees() == 0.001);
  CHECK(data.angles[0].phi_i.degrees() == 180);
}
