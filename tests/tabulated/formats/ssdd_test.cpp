// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/ssdd.hpp"

#include <cmath>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/lattice_table.hpp"
#include "tests/random_directions.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::faults_of;

namespace {

using Writer = ExportNotes (*)(const Opened&, const std::filesystem::path&, const WriteOptions&);
constexpr Writer writers[] = {write_ssdd, write_ssdd_binary, write_ssdd_spherical, write_ssdd_specular, write_ssdd_distorted};

/// Smooth; on demand not the same on both sides of the plane of incidence, or dependent on phi_i.
class Smooth final : public Brdf {
 public:
  explicit Smooth(Symmetry symmetry) : symmetry_(symmetry), channels_(rgb_channels()) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return symmetry_; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) {
      double value = 1 + 0.3 * wi[k].z() * wo[k].z() + 0.2 * dot(wi[k], wo[k]);
      if (!symmetry_.bilateral) value += 0.1 * (wi[k].x() * wo[k].y() - wi[k].y() * wo[k].x());
      if (!symmetry_.isotropic) value += 0.1 * (wi[k].x() + wo[k].x());
      for (std::size_t c = 0; c < 3; ++c) f[3 * k + c] = value * static_cast<double>(c + 1);
    }
  }

 private:
  Symmetry symmetry_;
  Channels channels_;
};

Opened source_of(const Symmetry& symmetry) {
  Opened out;
  out.format = "test";
  out.brdf = std::make_shared<Smooth>(symmetry);
  return out;
}

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

Opened open(const std::string& text, const ReadOptions& options = {}) {
  const test::TemporaryFolder scratch;
  return open_brdf(scratch.file("x.ssdd", text), options);
}

const std::string lambert =
    "VERSION 0.3\n\n# a comment\nSOFTWARE x\nDATA_TYPE brdf\nCOLOR_MODEL monochrome\nPARAM_TYPE spherical_coordinate_system\n"
    "PARAM0_LIST 0 80\nPARAM2_LIST 0\nPARAM3_LIST 0\nDATA ascii\n# PARAM3: 0\n0.3183\n\n0.25\n";
const std::string mirror =
    "\nDATA_TYPE specular_reflectance\nCOLOR_MODEL spectrum\nWAVELENGTH_LIST 400 500\nPARAM0_LIST 0 90\nDATA ascii\n.1 .2\n.3 .4\n";

}  // namespace

TEST_CASE("Every coordinate system and symmetry comes back at the nodes and between them") {
  // Linear between 5 to 22 degrees of a function with second derivatives below 1; floats in their shortest decimal form round twice.
  constexpr double linear = 0.05, to_float = 1.2e-7;
  const test::TemporaryFolder scratch;
  for (const Symmetry& symmetry : {Symmetry{true, true, false}, Symmetry{true, false, false}, Symmetry{false, false, false}}) {
    const Opened source = source_of(symmetry);
    for (const Writer write : writers) {
      write(source, scratch / "x.ssdd", paper());
      const Opened read = open_brdf(scratch / "x.ssdd");
      CHECK(read.format == "ssdd");
      INFO(read.info[2].second);
      CHECK(read.brdf->channels() == rgb_channels());
      CHECK(read.brdf->symmetry().isotropic == symmetry.isotropic);
      test::Random random(test::seed);
      double worst = 0;
      for (int k = 0; k < 2000; ++k) {
        const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
        if (wi.z() < 0.2 || wo.z() < 0.2) continue;
        worst = std::max(worst, std::fabs(read.brdf->eval(wi, wo)[1] / source.brdf->eval(wi, wo)[1] - 1));
      }
      CHECK(worst < linear);
      for (std::size_t k = 0; k < read.dataset->size(); k += 1009) {
        const GonioAngles& at = read.dataset->angles[k];
        CHECK(read.dataset->f[2][k] == Approx(source.brdf->eval(at.wi(), at.wo())[2]).epsilon(to_float));
      }
      // Written again from its own reading the file is the same.
      const bool binary = write == write_ssdd_binary;
      (binary ? write_ssdd_binary : write_ssdd)(read, scratch / "again.ssdd", {});
      const std::string again = test::read_file(scratch / "again.ssdd"), was = test::read_file(scratch / "x.ssdd");
      // "measured" instead of "generated" in one line.
      const std::size_t data = was.find("DATA_TYPE");
      const bool same = again.substr(again.find("\nDATA ")) == was.substr(was.find("\nDATA ")) &&
                        again.substr(0, again.find("SOURCE")) == was.substr(0, was.find("SOURCE")) && data != std::string::npos;
      CHECK(same);
    }
  }
}

TEST_CASE("Text and binary numbers are the same") {
  const test::TemporaryFolder scratch;
  const Opened source = source_of({true, true, false});
  write_ssdd(source, scratch / "text", paper());
  write_ssdd_binary(source, scratch / "binary", paper());
  const Opened text = open_brdf(scratch / "text"), binary = open_brdf(scratch / "binary");
  const auto &a = dynamic_cast<const LatticeTable&>(*text.brdf), &b = dynamic_cast<const LatticeTable&>(*binary.brdf);
  bool same = a.lattice() == b.lattice();
  for (std::size_t k = 0; k < a.lattice().size(); ++k)
    same = same && static_cast<float>(a.values()[1][k]) == static_cast<float>(b.values()[1][k]);
  CHECK(same);
  CHECK(std::filesystem::file_size(scratch / "binary") < std::filesystem::file_size(scratch / "text"));
}

TEST_CASE("Comments, blank lines and other blocks are passed over; the block can be chosen") {
  const Opened read = open(lambert + mirror);
  CHECK(read.dataset->f[0] == std::vector<double>{0.3183, 0.25});
  CHECK(read.info[4].second == "brdf, specular_reflectance; read: brdf");
  CHECK(read.info.back() == std::pair<std::string, std::string>("specular_reflectance", "0.1 0.2 at 0 deg; 0.3 0.4 at 90 deg"));
  CHECK(faults_of([&] { open("VERSION 0.3\n" + mirror); }).find("brdf or btdf") != std::string::npos);
  std::string transmission = lambert.substr(lambert.find("DATA_TYPE"));
  transmission.replace(transmission.find("brdf"), 4, "btdf");
  ReadOptions options;
  options.assume["data_type"] = "btdf";
  CHECK(open(lambert + transmission, options).dataset->side == Side::transmission);
  CHECK(open("VERSION 0.3\n" + transmission).dataset->side == Side::transmission);
  CHECK(faults_of([&] { open(lambert, options); }).find("a block of DATA_TYPE btdf") != std::string::npos);
}

TEST_CASE("Distorted coordinates count from the specular direction, moved by the offsets, to the horizon") {
  // One number per polar angle: 0 at the pole, 45 half way to the horizon on the disk of zenith angles, 90 at the horizon.
  const std::string text =
      "VERSION 0.3\nDATA_TYPE btdf\nCOLOR_MODEL monochrome\nPARAM_TYPE distorted_spherical_coordinate_system\n"
      "PARAM0_LIST 0 60\nPARAM2_LIST 0 45 89\nPARAM3_LIST 0 90 180 270\nPARAM4_LIST 0 -20\nDATA ascii\n";
  std::string numbers;
  for (int azimuth = 0; azimuth < 4; ++azimuth) numbers += "0\n0\n45\n45\n89\n89\n";
  const Opened read = open(text + numbers);
  const Direction wi = Direction::spherical(60_deg, 0_deg);
  const auto at = [&](Angle theta, Angle phi) { return read.brdf->eval(wi, Direction::spherical(degrees(180) - theta, phi))[0]; };
  CHECK(std::fabs(at(40_deg, 180_deg)) < 1e-9);
  CHECK(at(65_deg, 180_deg) == Approx(45).epsilon(1e-9));
  CHECK(at(25_deg, 0_deg) == Approx(45).epsilon(1e-9));
  CHECK(read.dataset->side == Side::transmission);
}

TEST_CASE("Spectra have a channel per wavelength") {
  std::string text = lambert;
  text.replace(text.find("monochrome"), 10, "spectrum\nWAVELENGTH_LIST 450 550.5");
  text.replace(text.find("0.3183"), 6, "0.3 0.4"), text.replace(text.find("0.25\n"), 5, "0.1 0.2\n");
  const Opened read = open(text);
  REQUIRE(read.brdf->channels().size() == 2);
  CHECK(read.brdf->channels()[1].name == "550.5nm");
  CHECK(read.dataset->f[1] == std::vector<double>{0.4, 0.2});
}

TEST_CASE("Everything that is wrong with the key words is named at once, with its line") {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = lambert;
    text.replace(text.find(from), from.size(), to);
    return faults_of([&] { open(text); });
  };
  CHECK(with("PARAM0_LIST 0 80", "PARAM0_LIST 80 0").find(":8|0 after 80") != std::string::npos);
  CHECK(with("PARAM0_LIST 0 80", "PARAM0_LIST 0 nan").find("from 0 to 90") != std::string::npos);
  CHECK(with("spherical_", "disturbed_").find("distorted_spherical_coordinate_system") != std::string::npos);
  CHECK(with("spherical_", "distorted_spherical_").empty());
  CHECK(with("PARAM2_LIST 0", "PARAM1_LIST 10\nPARAM2_LIST 0").find("the one azimuth of incidence 10") != std::string::npos);
  CHECK(with("PARAM2_LIST 0", "REDUCTION_TYPE reciprocity\nPARAM2_LIST 0").find("half-difference coordinates") != std::string::npos);
  CHECK(with("0.25\n", "0.25 1\n").find("2 numbers|1, one per channel") != std::string::npos);
  CHECK(with("0.25\n", "inf\n").find("a finite number") != std::string::npos);
  CHECK(with("0.25\n", "\n").find("the end of the file after 1 lines") != std::string::npos);
  CHECK(with("DATA ascii", "DATA binary").find("numbers of 4 bytes") == std::string::npos);  // enough bytes, of text: wrong, but whole
  const std::string several = with("PARAM2_LIST 0\nPARAM3_LIST 0", "PARAM2_LIST -1\nREDUCTION_TYPE nothing");
  CHECK(several.find("PARAM3_LIST") != std::string::npos);
  CHECK(several.find("'nothing'") != std::string::npos);
  CHECK(several.find("'-1'") != std::string::npos);
}

TEST_CASE("Lists that promise more numbers than the file holds are refused") {
  std::string many = "PARAM0_LIST";
  for (int k = 0; k < 400; ++k) many += " " + std::to_string(k * 0.2);
  std::string text = lambert;
  for (const char* key : {"PARAM0_LIST 0 80", "PARAM2_LIST 0\n", "PARAM3_LIST 0\n"}) {
    std::string list = many;
    list[5] = key[5];
    text.replace(text.find(key), std::string(key).size(), list + (key[std::string(key).size() - 1] == '\n' ? "\n" : ""));
  }
  CHECK(faults_of([&] { open(text); }).find("too many angles") != std::string::npos);
}

TEST_CASE("No damaged .ssdd does more than raise an error") {
  const test::TemporaryFolder scratch;
  const std::string half_difference =
      "VERSION 0.3\nDATA_TYPE brdf\nCOLOR_MODEL rgb\nPARAM_TYPE half_difference_coordinate_system\nREDUCTION_TYPE bilateral_symmetry "
      "reciprocity\nPARAM0_LIST 0 45\nPARAM2_LIST 0 45\nPARAM3_LIST 0 90\nDATA binary\n" +
      std::string(96, '\x3e');
  const std::vector<std::string> seeds{lambert + mirror, half_difference};
  const std::string letters = std::string("0123456789.-+eE# \nLISTPARAM_DATA") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged(seeds, letters, 20260709, 3000, [&](const std::string& bytes) {
    const Opened opened = open_ssdd(scratch.file("damaged", bytes), {});
    opened.dataset->require_consistent();
    REQUIRE(opened.dataset->size() > 0);
  });
  CHECK(read > 100);
  CHECK(refused > 500);
}
