// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/lab_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tabulated/polar_integral.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

const std::string readings =
    "sheet,azimuth_deg,incidence_deg,receive_deg,RT,RT_per_nm\nSheet1,-90.0,30.0,60.0,0.5,1\nSheet1,-90.0,30.0,-30.0,0.1,1\n"
    "Sheet1,0.0,30.0,-30.0,0.2,1\n";
const std::string mueller =
    "lambda,thetai,phi,thetar,phir,f_r11,f_r12/f_r11\n0.351,-30,0,30,0,2.5E-01,0.01\n0.532,-30,0,30,0,3.5E-01,0.01\n";

ReadOptions perfect_white() {
  ReadOptions options;
  options.assume["white"] = "1";
  return options;
}

/// f by (azimuth from the light, incidence, receive) rounded to degrees.
using Pose = std::array<int, 3>;
std::map<Pose, double> by_pose(const Dataset& data) {
  std::map<Pose, double> out;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const GonioAngles& a = data.angles[k];
    int turn = static_cast<int>(std::lround(a.phi_o.degrees() - a.phi_i.degrees())) % 360;
    if (turn < 0) turn += 360;
    out[{turn, static_cast<int>(std::lround(a.theta_i.degrees())), static_cast<int>(std::lround(a.theta_o.degrees()))}] = data.f[0][k];
  }
  return out;
}

Dataset rt300s(const std::string& name, bool keep_blocked) {
  ReadOptions options = perfect_white();
  options.blank = test::measured_data("loft_rt300s/raw_csv/blank_v2o0_20250911.csv").value();
  if (keep_blocked) options.assume["blocked"] = "keep";
  const Opened opened = open_brdf(test::measured_data("loft_rt300s/raw_csv/" + name).value(), options);
  CHECK(opened.format == "rt300s");
  return *opened.dataset;
}

double median_log_ratio(const std::map<Pose, double>& a, const std::map<Pose, double>& b) {
  std::vector<double> ratios;
  for (const auto& [pose, f] : a)
    if (const auto other = b.find(pose); other != b.end() && f > 0 && other->second > 0)
      ratios.push_back(std::fabs(std::log(f / other->second)));
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace

TEST_CASE("RT-300S readings are known by their header and become f once the white is known; the head of the detector is masked") {
  const TemporaryFolder scratch;
  const auto path = scratch.file("readings.csv", readings);
  CHECK(faults_of([&] { open_brdf(path); }).find("--assume white=1") != std::string::npos);
  const Opened opened = open_brdf(path, perfect_white());
  CHECK(opened.format == "rt300s");
  REQUIRE(opened.dataset->size() == 2);
  CHECK(opened.masked.blocked == 1);
  CHECK(std::fabs(opened.dataset->f[0][0] - 0.5 / (std::numbers::pi * 0.5)) < 1e-15);
  const GonioAngles& specular_side = opened.dataset->angles[0];
  CHECK(std::fabs(specular_side.phi_o.degrees() - specular_side.phi_i.degrees()) == 180);
  ReadOptions keep = perfect_white();
  keep.assume["blocked"] = "keep";
  keep.assume["white"] = "0.99";
  keep.assume["isotropic"] = "yes";
  const Opened kept = open_brdf(path, keep);
  CHECK(kept.dataset->size() == 3);
  CHECK(kept.brdf->symmetry().isotropic);
  CHECK(std::fabs(kept.dataset->f[0][0] / opened.dataset->f[0][0] - 0.99) < 1e-12);
  ReadOptions columns;
  columns.columns = {{"phi_o_deg", "azimuth_deg"}, {"theta_i_deg", "incidence_deg"}, {"theta_o_deg", "receive_deg"}, {"value", "RT"}};
  columns.set = {{"phi_i_deg", 90}};
  CHECK(open_brdf(path, columns).format == "csv");
  keep.assume["blocked"] = "maybe";
  CHECK(faults_of([&] { open_brdf(path, keep); }).find("mask or keep") != std::string::npos);
}

TEST_CASE("NIST's file is known by its header: micrometres become channels, negative incidence puts specular at azimuth 0") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("ptfe.csv", mueller));
  CHECK(opened.format == "nist");
  REQUIRE(opened.dataset->size() == 1);
  REQUIRE(opened.dataset->channels.size() == 2);
  CHECK(opened.dataset->channels[1].wavelength_in_nm == 532);
  CHECK(opened.dataset->f[1][0] == 0.35);
  const GonioAngles& pose = opened.dataset->angles[0];
  CHECK(pose.theta_i.degrees() == 30);
  CHECK(std::fabs(pose.phi_o.degrees() - pose.phi_i.degrees()) == 180);
  CHECK(opened.dataset->provenance.at("columns_left_out").find("f_r12") != std::string::npos);
}

TEST_CASE("The black coating on the RT-300S gives its reference figures without a flag for any column") {
  const auto path = test::measured_data("loft_rt300s/raw_csv/ANOPLATE_AnoBlack_EC1_Alum6061_v1o0_20251115.csv");
  if (!path) return;
  const Dataset data = rt300s(path->filename().string(), true);
  CHECK(data.size() == 2508);
  std::map<int, std::pair<double, int>> normal;
  for (std::size_t k = 0; k < data.size(); ++k)
    if (data.angles[k].theta_o.degrees() == 0) {
      auto& [sum, count] = normal[static_cast<int>(data.angles[k].theta_i.degrees())];
      sum += data.f[0][k], ++count;
    }
  constexpr double printed_digits = 5e-6;
  for (const auto& [incidence, reference] : std::map<int, double>{{10, 0.03246}, {30, 0.02044}, {50, 0.01195}, {70, 0.00851}})
    CHECK(std::fabs(normal[incidence].first / normal[incidence].second - reference) <= printed_digits);

  // Partner pairs: azimuth -90 with receive > 0 and +90 with receive < 0 are the same side of the plane; the figures are of their means.
  std::map<Pose, std::pair<double, int>> sides;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const GonioAngles& a = data.angles[k];
    if (std::fabs(std::remainder(a.phi_o.degrees() - a.phi_i.degrees(), 360.0)) != 180) continue;
    auto& [sum, count] = sides[{180, static_cast<int>(a.theta_i.degrees()), static_cast<int>(a.theta_o.degrees())}];
    sum += data.f[0][k], ++count;
  }
  const auto mean = [&](int in, int out) { return sides.at({180, in, out}).first / sides.at({180, in, out}).second; };
  CHECK(std::fabs(mean(10, 30) / mean(30, 10) - 0.907) < 5e-4);
  CHECK(std::fabs(mean(10, 50) / mean(50, 10) - 0.915) < 5e-4);
  CHECK(std::fabs(mean(30, 50) / mean(50, 30) - 0.947) < 5e-4);
  CHECK(std::fabs(mean(50, 70) / mean(70, 50) - 0.900) < 5e-4);
  // The integral of f cos theta_o up to 80 degrees, directions of both sides averaged.
  for (const auto& [incidence, reference] : std::map<int, double>{{10, 0.0508}, {30, 0.0518}, {50, 0.0556}, {70, 0.0850}}) {
    std::map<std::pair<int, int>, std::pair<double, int>> nodes;
    for (std::size_t k = 0; k < data.size(); ++k) {
      const GonioAngles& a = data.angles[k];
      if (std::lround(a.theta_i.degrees()) != incidence) continue;
      const int turn = static_cast<int>(std::lround(a.phi_o.degrees() - a.phi_i.degrees()));
      auto& [sum, count] = nodes[{static_cast<int>(std::lround(a.theta_o.degrees())), ((turn % 360) + 360) % 360}];
      sum += data.f[0][k], ++count;
    }
    std::vector<double> theta, phi, f;
    for (int t = 0; t <= 80; t += 5) theta.push_back(t);
    for (int p = 0; p < 360; p += 10) phi.push_back(p);
    for (const double t : theta)
      for (const double p : phi) {
        if (t == 0) {
          f.push_back(0);  // the normal has no solid angle
          continue;
        }
        const auto& [sum, count] = nodes.at({static_cast<int>(t), static_cast<int>(p)});
        f.push_back(sum / count);
      }
    CHECK(std::fabs(polar_integral(theta, phi, f) / reference - 1) < 0.03);
  }
  const Dataset masked = rt300s(path->filename().string(), false);
  CHECK(masked.masked.blocked > 0);
  CHECK(masked.size() + masked.masked.blocked == 2508);
}

TEST_CASE("Turning NiTE on steel changes it by 3 to 7 per cent, turning IMX455 by 29 to 43") {
  if (!test::measured_data("loft_rt300s/raw_csv/IMX455_stageRotation0_20250922.csv")) return;
  const auto medians = [](const std::vector<std::string>& names) {
    std::vector<std::map<Pose, double>> rotations;
    for (const std::string& name : names) rotations.push_back(by_pose(rt300s(name, true)));
    std::vector<double> out;
    for (std::size_t a = 0; a < rotations.size(); ++a)
      for (std::size_t b = a + 1; b < rotations.size(); ++b) out.push_back(median_log_ratio(rotations[a], rotations[b]));
    return out;
  };
  for (const double median :
       medians({"NiTE_on_steel_v1o0A_20250915.csv", "NiTE_on_steel_v1o0B_20250916.csv", "NiTE_on_steel_v1o0C_20250916.csv"}))
    CHECK((median > 0.03 && median < 0.07));
  for (const double median : medians({"IMX455_stageRotation0_20250922.csv", "IMX455_stageRotation30_20250922.csv",
                                      "IMX455_stageRotation60_20250922.csv", "IMX455_stageRotation90_20250922.csv"}))
    CHECK((median > 0.28 && median < 0.44));
}

TEST_CASE("Every file of the RT-300S reads, in plane and not, blanks included") {
  const auto first = test::measured_data("loft_rt300s/raw_csv/MagicBlack_v1o0_20250829.csv");
  if (!first) return;
  for (const auto& file : std::filesystem::directory_iterator(first->parent_path())) {
    INFO(file.path());
    CHECK(open_brdf(file.path(), perfect_white()).dataset->size() > 500);
  }
}

TEST_CASE("NIST's PTFE at 532 nm: the mean at normal incidence and the symmetry about the plane of incidence are as published") {
  const auto path = test::measured_data("nist_ptfe/PTFE.data.csv");
  if (!path) return;
  const Opened opened = open_brdf(*path);
  CHECK(opened.format == "nist");
  const Dataset& data = *opened.dataset;
  REQUIRE(data.channels.size() == 4);
  const auto green = static_cast<std::size_t>(
      std::find_if(data.channels.begin(), data.channels.end(), [](const Channel& c) { return c.wavelength_in_nm == 532; }) -
      data.channels.begin());
  REQUIRE(green < 4);
  std::size_t samples = 0;
  double sum = 0;
  int count = 0;
  std::map<std::array<long, 3>, double> at;
  for (std::size_t k = 0; k < data.size(); ++k) {
    if (std::isnan(data.f[green][k])) continue;
    ++samples;
    const GonioAngles& a = data.angles[k];
    if (a.theta_i.degrees() < 0.01) sum += data.f[green][k], ++count;
    const auto thousandth = [](double degrees) { return std::lround(degrees * 1000); };
    at[{thousandth(a.theta_i.degrees()), thousandth(a.theta_o.degrees()), thousandth(std::remainder(a.phi_o.degrees(), 360.0))}] =
        data.f[green][k];
  }
  CHECK(samples == 1824);
  CHECK(std::fabs(sum / count - 0.3144) < 5e-5);
  // f(phi) against f(-phi), mean of |ln| by incidence.
  std::map<long, std::pair<double, int>> mirror;
  for (const auto& [pose, f] : at) {
    const auto other = at.find({pose[0], pose[1], -pose[2]});
    if (pose[2] <= 0 || pose[2] >= 180000 || other == at.end()) continue;
    mirror[pose[0]].first += std::fabs(std::log(f / other->second)), ++mirror[pose[0]].second;
  }
  REQUIRE_FALSE(mirror.empty());
  double all = 0;
  int pairs = 0;
  for (const auto& [incidence, difference] : mirror) {
    INFO("incidence " << incidence << " pairs " << difference.second);

    CHECK(difference.first / difference.second < 0.02);
    all += difference.first, pairs += difference.second;
  }
  CHECK(all / pairs > 0.006);
  CHECK(all / pairs < 0.014);
}

TEST_CASE("No damaged file of the RT-300S or of NIST does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE,;\t \r\n\"#") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({readings, mueller}, letters, 20260715, 4000, [&](const std::string& bytes) {
    const auto path = scratch.file("damaged", bytes);
    const bool is_nist = bytes.starts_with("lambda") || bytes.find("thetar") != std::string::npos;
    (is_nist ? open_nist(path, {}) : open_rt300s(path, perfect_white())).dataset->require_consistent();
  });
  CHECK(read > 200);
  CHECK(refused > 500);
}
