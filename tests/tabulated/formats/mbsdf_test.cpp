// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/mbsdf.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/lattice_table.hpp"
#include "tests/random_directions.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::faults_of;
using test::read_file;

namespace {

Opened model(const char* name, std::vector<double> parameters, Channels channels = rgb_channels()) {
  Opened out;
  out.format = "test";
  out.brdf = std::make_shared<AnalyticBrdf>(name, channels, std::vector<std::vector<double>>(channels.size(), parameters));
  return out;
}

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

std::string number(std::uint32_t value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }
std::string number(float value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

/// A file of 2 x 2 x 2 scalar cells with the values 1 to 8.
std::string small(const std::string& block = "MBSDF_DATA=\n") {
  std::string out = "NVIDIA ARC MBSDF V1\nmaterial=\"felt\"\n" + block + number(0U) + number(2U) + number(2U);
  for (int k = 1; k <= 8; ++k) out += number(static_cast<float>(k));
  return out;
}

Opened open(const std::string& bytes, const ReadOptions& options = {}) {
  const test::TemporaryFolder scratch;
  return open_brdf(scratch.file("x.mbsdf", bytes), options);
}

double worst_difference(const Brdf& read, const Brdf& was) {
  test::Random random(test::seed);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.17 || wo.z() < 0.17) continue;
    worst = std::max(worst, std::fabs(read.eval(wi, wo)[0] / was.eval(wi, wo)[0] - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("Cells lie [theta_i][theta_o][azimuth] with their values in the centres, or at the left edge if one says so") {
  const Opened read = open(small());
  CHECK(read.format == "mbsdf");
  CHECK(read.dataset->size() == 8);
  const auto at = [](const Opened& file, double theta_i, double theta_o, double phi) {
    return file.brdf->eval(Direction::spherical(degrees(theta_i), 10_deg), Direction::spherical(degrees(theta_o), degrees(10 - phi)))[0];
  };
  CHECK(at(read, 22.5, 22.5, 45) == Approx(1));
  CHECK(at(read, 22.5, 22.5, 135) == Approx(2));
  CHECK(at(read, 22.5, 67.5, 45) == Approx(3));
  CHECK(at(read, 67.5, 22.5, 45) == Approx(5));
  CHECK(at(read, 45, 45, 90) == Approx(4.5));
  ReadOptions left;
  left.assume["nodes"] = "left";
  CHECK(at(open(small(), left), 45, 45, 90) == Approx(8));
  left.assume["nodes"] = "right";
  CHECK(faults_of([&] { open(small(), left); }).find("usage|") == 0);
}

TEST_CASE("Reflection and transmission are told apart; the part can be chosen") {
  const std::string both = small("MBSDF_DATA_REFLECTION=\n") + small("MBSDF_DATA_TRANSMISSION=\n").substr(36);
  CHECK(open(both).dataset->side == Side::reflection);
  ReadOptions options;
  options.assume["part"] = "transmission";
  CHECK(open(both, options).dataset->side == Side::transmission);
  CHECK(open(small("MBSDF_DATA_TRANSMISSION=\n")).dataset->side == Side::transmission);
  CHECK(faults_of([&] { open(small(), options); }).find("no such part") != std::string::npos);
}

TEST_CASE("A model written and read again is the same at the nodes and near it between them") {
  constexpr double to_float = 6e-8;
  const test::TemporaryFolder scratch;
  const Opened phong = model("phong", {0.2, 0.3, 20});
  const ExportNotes notes = write_mbsdf(phong, scratch / "x.mbsdf", paper());
  CHECK(std::filesystem::file_size(scratch / "x.mbsdf") > std::size_t{45} * 45 * 90 * 12);
  CHECK(notes.n_nodes == std::size_t{45} * 45 * 90);
  const Opened read = open_brdf(scratch / "x.mbsdf");
  for (std::size_t k = 0; k < read.dataset->size(); k += 997) {
    const GonioAngles& at = read.dataset->angles[k];
    CHECK(read.dataset->f[2][k] == Approx(phong.brdf->eval(at.wi(), at.wo())[2]).epsilon(to_float));
  }
  // Steps of 2 degrees against a lobe of half-width 15 degrees, and grazing directions.
  CHECK(worst_difference(*read.brdf, *phong.brdf) < 0.05);
  // Written again from its own reading the values are the same bits.
  write_mbsdf(read, scratch / "again.mbsdf", {});
  const std::string a = read_file(scratch / "x.mbsdf"), b = read_file(scratch / "again.mbsdf");
  const std::size_t numbers = std::size_t{45} * 45 * 90 * 12;
  CHECK(std::memcmp(a.data() + a.size() - numbers, b.data() + b.size() - numbers, numbers) == 0);

  // One channel stays one.
  write_mbsdf(model("lambert", {0.5}, single_channel("value")), scratch / "one.mbsdf", paper());
  CHECK(open_brdf(scratch / "one.mbsdf").brdf->channels().size() == 1);
}

TEST_CASE("The real file of a red car paint: negative values, and the peak at the last azimuth") {
  const auto path = test::measured_data("mdl/carpaint_red.mbsdf");
  if (!path) return;
  const Opened read = open_brdf(*path);
  CHECK(read.format == "mbsdf");
  const auto& table = dynamic_cast<const LatticeTable&>(*read.brdf);
  CHECK(table.lattice().nodes_deg[0].size() == 45);
  CHECK(table.lattice().nodes_deg[3].size() == 90);
  std::size_t negative = 0;
  for (const double value : table.values()[1]) negative += value < 0;
  CHECK(negative > 0);
  const Direction wi = Direction::spherical(45_deg, 0_deg);
  const auto at = [&](double phi) { return table.eval(wi, Direction::spherical(45_deg, degrees(phi)))[0]; };
  CHECK(at(179) > 3 * at(90));
  CHECK(at(179) > 3 * at(1));
  const test::TemporaryFolder scratch;
  write_mbsdf(read, scratch / "again.mbsdf", {});
  const std::string a = read_file(*path), b = read_file(scratch / "again.mbsdf");
  const std::size_t numbers = std::size_t{45} * 45 * 90 * 12;
  CHECK(std::memcmp(a.data() + a.size() - numbers, b.data() + b.size() - numbers, numbers) == 0);
}

TEST_CASE("Sizes that the file does not keep are refused before anything is allocated") {
  const std::string header = "NVIDIA ARC MBSDF V1\nMBSDF_DATA=\n";
  CHECK(faults_of([&] { open(header + number(1U) + number(1000U) + number(1000U)); }).find("1000 zenith angles") != std::string::npos);
  CHECK(faults_of([&] { open(header + number(1U) + number(0xffffffffU) + number(0xffffffffU)); }).find("4294967295") != std::string::npos);
  CHECK(faults_of([&] { open(header + number(0U) + number(0U) + number(1U)); }).find("0 zenith angles") != std::string::npos);
  CHECK(faults_of([&] { open(header + number(7U) + number(1U) + number(1U)); }).find("type 7") != std::string::npos);
  CHECK(faults_of([&] { open("NVIDIA ARC MBSDF V1\n=\"nameless\"\nMBSDF_DATA=\n" + number(0U)); }).find("key=\"value\"") !=
        std::string::npos);
  CHECK(faults_of([&] { open(small() + "x"); }).find("1 bytes more") != std::string::npos);
  const std::string whole = small();
  for (std::size_t length = 20; length < whole.size(); ++length) {
    INFO(length);
    CHECK_FALSE(faults_of([&] { open(whole.substr(0, length)); }).empty());
  }
  CHECK(faults_of([&] {
          open(header + number(0U) + number(1U) + number(1U) + number(std::numeric_limits<float>::infinity()));
        }).find("an infinity") != std::string::npos);
}

TEST_CASE("An anisotropic source has no place in the format") {
  const test::TemporaryFolder scratch;
  const auto samples = scratch.file("x.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,1\n30,90,40,180,2\n");
  CHECK(faults_of([&] { write_mbsdf(open_brdf(samples), scratch / "x.mbsdf", {}); }).find("depends on phi_i") != std::string::npos);
}

TEST_CASE("No damaged .mbsdf does more than raise an error") {
  const test::TemporaryFolder scratch;
  const std::string seed = small("MBSDF_DATA_REFLECTION=\n") + small("MBSDF_DATA_TRANSMISSION=\n").substr(36);
  const std::string letters = std::string("\1\2=\"\nMBSDFATA_\x7f\x80") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({seed}, letters, 20260708, 3000, [&](const std::string& bytes) {
    const Opened opened = open_mbsdf(scratch.file("damaged", bytes), {});
    opened.dataset->require_consistent();
    REQUIRE(opened.dataset->size() > 0);
  });
  CHECK(read > 100);
  CHECK(refused > 500);
}
