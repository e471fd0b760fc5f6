// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/utia.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/exr_image.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::faults_of;

namespace {

constexpr std::size_t file_size = 1990656, side = 288;

Opened model() {
  Opened out;
  out.format = "test";
  out.brdf = std::make_shared<AnalyticBrdf>("phong", rgb_channels(),
                                            std::vector<std::vector<double>>{{0.1, 0.3, 5}, {0.2, 0.3, 5}, {0.3, 0.3, 5}});
  return out;
}

ReadOptions with(const char* values) {
  ReadOptions out;
  out.assume["values"] = values;
  return out;
}

double number_at(const std::string& bytes, std::size_t index) {
  double out = 0;
  std::memcpy(&out, bytes.data() + 8 * index, sizeof out);
  return out;
}

}  // namespace

TEST_CASE("Planes of rows theta_i, phi_i and columns theta_o, phi_o hold f") {
  const test::TemporaryFolder scratch;
  write_utia(model(), scratch / "x.bin", {});
  const std::string bytes = test::read_file(scratch / "x.bin");
  REQUIRE(bytes.size() == file_size);
  // theta_i 30, phi_i 15, theta_o 45, phi_o 202.5, green.
  const std::size_t index = 82944 + (48 * 2 + 2) * 288 + 48 * 3 + 27;
  const std::vector<double> f = model().brdf->eval(Direction::spherical(30_deg, 15_deg), Direction::spherical(45_deg, 202.5_deg));
  CHECK(number_at(bytes, index) == f[1]);

  const Opened read = open_brdf(scratch / "x.bin", with("f"));
  CHECK(read.format == "utia");
  const std::vector<double> again = read.brdf->eval(Direction::spherical(30_deg, 15_deg), Direction::spherical(45_deg, 202.5_deg));
  CHECK(again[1] == Approx(f[1]).epsilon(1e-9));
  // Between the nodes the grid of 15 degrees bends a lobe of half-width 30 degrees.
  const Direction wi = Direction::spherical(22_deg, 4_deg), wo = Direction::spherical(50_deg, 187_deg);
  CHECK(read.brdf->eval(wi, wo)[0] == Approx(model().brdf->eval(wi, wo)[0]).epsilon(0.15));
  CHECK_FALSE(read.brdf->symmetry().isotropic);
  write_utia(read, scratch / "again.bin", {});
  CHECK((test::read_file(scratch / "again.bin") == bytes));
}

TEST_CASE("Codes for display come back as the values they stand for") {
  const test::TemporaryFolder scratch;
  write_utia_display(model(), scratch / "x.bin", {});
  const Opened read = open_brdf(scratch / "x.bin", with("display"));
  for (std::size_t k = 0; k < read.dataset->size(); k += 101) {
    const GonioAngles& at = read.dataset->angles[k];
    CHECK(read.dataset->f[2][k] == Approx(model().brdf->eval(at.wi(), at.wo())[2]).epsilon(1e-9));
  }
  // 140 is the code of 1, which stands for f = 100.
  const std::string white = [] {
    const double code = 140;
    std::string bytes;
    while (bytes.size() < file_size) bytes.append(reinterpret_cast<const char*>(&code), sizeof code);
    return bytes;
  }();
  CHECK(open_brdf(scratch.file("white", white), with("display")).dataset->f[0][0] == Approx(100));
  CHECK(open_brdf(scratch.file("white", white), with("f")).dataset->f[0][0] == 140);
}

TEST_CASE("Without an answer, with a wrong one, a wrong size or numbers that are none the file is refused") {
  const test::TemporaryFolder scratch;
  write_utia(model(), scratch / "x.bin", {});
  CHECK(faults_of([&] { open_brdf(scratch / "x.bin"); }).find("--assume values=f") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch / "x.bin", with("g")); }).find("usage|") == 0);
  std::string bytes = test::read_file(scratch / "x.bin");
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::memcpy(bytes.data() + 800000, &number, sizeof number);
    CHECK(faults_of([&] { open_brdf(scratch.file("y", bytes), with("f")); }).find("byte 800000") != std::string::npos);
  }
  ReadOptions forced = with("f");
  forced.format = "utia";
  for (const std::size_t length : {std::size_t{0}, std::size_t{8}, file_size - 1})
    CHECK(faults_of([&] { open_brdf(scratch.file("y", bytes.substr(0, length)), forced); }).find("1990656") != std::string::npos);
  // Text of that very size is no table.
  CHECK(faults_of([&] { open_brdf(scratch.file("y", std::string(file_size, 'x')), {}); }).find("utia") == std::string::npos);
}

TEST_CASE("A picture has a row per direction of light and a column per direction of view, and says as little of its numbers") {
  const test::TemporaryFolder scratch;
  const ExportNotes notes = write_utia_exr(model(), scratch / "x.exr", {});
  CHECK(notes.assume.at("values") == "f");
  const ExrImage image = read_exr_image(scratch / "x.exr");
  REQUIRE(image.width == side);
  REQUIRE(image.height == side);
  // theta_i 30, phi_i 15; theta_o 45, phi_o 202.5.
  const std::vector<double> f = model().brdf->eval(Direction::spherical(30_deg, 15_deg), Direction::spherical(45_deg, 202.5_deg));
  constexpr double to_float = 6e-8;
  for (const auto& [name, values] : image.channels)
    CHECK(values[(48 * 2 + 2) * side + 48 * 3 + 27] == Approx(f[name == "R" ? 0 : name == "G" ? 1 : 2]).epsilon(to_float));

  write_utia(model(), scratch / "x.bin", {});
  const Opened picture = open_brdf(scratch / "x.exr", with("f")), plain = open_brdf(scratch / "x.bin", with("f"));
  CHECK(picture.format == "utia-exr");
  REQUIRE(picture.dataset->size() == plain.dataset->size());
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < plain.dataset->size(); ++k)
      worst = std::max(worst, std::fabs(picture.dataset->f[c][k] / plain.dataset->f[c][k] - 1));
  CHECK(worst < to_float);
  write_utia_exr(picture, scratch / "again.exr", {});
  CHECK((test::read_file(scratch / "again.exr") == test::read_file(scratch / "x.exr")));

  CHECK(faults_of([&] { open_brdf(scratch / "x.exr"); }).find("--assume values=f") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch / "x.exr", with("g")); }).find("usage|") == 0);
}

TEST_CASE("Pictures of another size, without colours or with numbers that are none are no table") {
  const test::TemporaryFolder scratch;
  ExrImage image{side, side, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.emplace_back(name, std::vector<float>(side * side, 0.5F));
  const auto faults = [&] {
    write_exr_image(image, scratch / "x.exr");
    ReadOptions forced = with("display");
    forced.format = "utia-exr";
    return faults_of([&] { open_brdf(scratch / "x.exr", forced); });
  };
  CHECK(faults().empty());
  image.channels[1].second[side + 2] = NAN;
  CHECK(faults().find("pixel (2, 1) of G|nan") != std::string::npos);
  image.channels.pop_back();
  CHECK(faults().find("no channel B") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch / "x.exr", {}); }).find("utia") == std::string::npos);
  image = {2, 3, {{"R", std::vector<float>(6)}, {"G", std::vector<float>(6)}, {"B", std::vector<float>(6)}}, {}};
  CHECK(faults().find("2 x 3 pixels|288 x 288") != std::string::npos);
}

TEST_CASE("No damaged table of UTIA, plain or a picture, does more than raise an error") {
  const test::TemporaryFolder scratch;
  write_utia(model(), scratch / "x.bin", {});
  ExrImage image{side, side, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.emplace_back(name, std::vector<float>(side * side, 0.5F));
  write_exr_image(image, scratch / "x.exr");
  const std::string letters = std::string("\0\1\x7f\x80\xf0\xff", 6);
  struct Variant {
    const char* seed;
    Opened (*open)(const std::filesystem::path&, const ReadOptions&);
    int rounds;
  };
  for (const Variant& variant : {Variant{"x.bin", open_utia, 300}, Variant{"x.exr", open_utia_exr, 3000}}) {
    int turn = 0;
    const auto [read, refused] =
        test::read_damaged({test::read_file(scratch / variant.seed)}, letters, 20260711, variant.rounds, [&](const std::string& bytes) {
          const Opened opened = variant.open(scratch.file("damaged", bytes), with(++turn % 2 == 0 ? "f" : "display"));
          opened.dataset->require_consistent();
        });
    INFO(variant.seed);
    CHECK(read > 30);
    CHECK(refused > 150);
  }
}
