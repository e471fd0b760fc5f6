// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/exr_image.hpp"
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

constexpr double to_float = 6e-8;

Opened model(const Channels& channels = rgb_channels()) {
  Opened out;
  out.format = "test";
  std::vector<std::vector<double>> parameters;
  for (std::size_t c = 0; c < channels.size(); ++c) parameters.push_back({0.1 + 0.1 * static_cast<double>(c), 0.3, 20});
  out.brdf = std::make_shared<AnalyticBrdf>("blinn-phong", channels, parameters);
  return out;
}

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

const std::vector<float>& channel(const ExrImage& image, const std::string& name) {
  return std::find_if(image.channels.begin(), image.channels.end(), [&](const auto& known) { return known.first == name; })->second;
}

}  // namespace

TEST_CASE("An atlas comes back at its nodes and between them, in both parameterisations") {
  // Steps of 3 degrees and less of a lobe of half-width 15 degrees; to 80 degrees. Between theta_i and theta_o the peak runs diagonally.
  constexpr double along_the_peak = 0.03, across_it = 0.12;
  const test::TemporaryFolder scratch;
  for (auto* write : {write_exr_atlas, write_exr_atlas_spherical}) {
    write(model(), scratch / "x.exr", {});
    const Opened read = open_brdf(scratch / "x.exr");
    CHECK(read.format == "exr-atlas");
    CHECK(read.brdf->channels() == rgb_channels());
    for (std::size_t k = 0; k < read.dataset->size(); k += 1013) {
      const GonioAngles& at = read.dataset->angles[k];
      CHECK(read.dataset->f[1][k] == Approx(model().brdf->eval(at.wi(), at.wo())[1]).epsilon(to_float));
    }
    test::Random random(test::seed);
    double worst = 0;
    for (int k = 0; k < 3000; ++k) {
      const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
      if (wi.z() < 0.17 || wo.z() < 0.17) continue;
      worst = std::max(worst, std::fabs(read.brdf->eval(wi, wo)[0] / model().brdf->eval(wi, wo)[0] - 1));
    }
    CHECK(worst < (write == write_exr_atlas ? along_the_peak : across_it));
    write_exr_atlas(read, scratch / "again.exr", {});
    CHECK((test::read_file(scratch / "again.exr") == test::read_file(scratch / "x.exr")));
  }
}

TEST_CASE("Tiles stand below each other, theta_h to the right and theta_d down; attributes hold the angles") {
  const test::TemporaryFolder scratch;
  write_exr_atlas(model(), scratch / "x.exr", paper());
  const ExrImage image = read_exr_image(scratch / "x.exr");
  REQUIRE(image.width == 32);
  REQUIRE(image.height == 32 * 9);
  // Column 4 is theta_h = 90 (4/31)², row 8 of tile 3 is theta_d = 90 · 8/31 at phi_d = 67.5.
  const double theta_h = 90 * 16.0 / 961;
  const DirectionPair at = directions({degrees(theta_h), 0_deg, degrees(90 * 8.0 / 31), 67.5_deg});
  CHECK(static_cast<double>(channel(image, "G")[(3 * 32 + 8) * 32 + 4]) == Approx(model().brdf->eval(at.wi, at.wo)[1]).epsilon(to_float));
  CHECK(std::count_if(image.attributes.begin(), image.attributes.end(), [](const auto& a) { return a.first == "tiles_deg"; }) == 1);
  for (const float value : channel(image, "R")) CHECK(std::isfinite(value));
}

TEST_CASE("The slice is a picture: theta_h to the right, theta_d upwards, phi_d = 90 degrees") {
  const test::TemporaryFolder scratch;
  write_exr_slice(model(), scratch / "x.exr", paper());
  const ExrImage image = read_exr_image(scratch / "x.exr");
  REQUIRE(image.width == 128);
  const double step = 90.0 / 128;
  const DirectionPair at = directions({degrees(10.5 * step), 0_deg, degrees(20.5 * step), 90_deg});
  CHECK(static_cast<double>(channel(image, "B")[(127 - 20) * 128 + 10]) == Approx(model().brdf->eval(at.wi, at.wo)[2]).epsilon(to_float));
  for (const float value : channel(image, "B")) CHECK(value > 0);  // no direction of this slice is below the horizon
}

TEST_CASE("Spectra keep their order") {
  const test::TemporaryFolder scratch;
  Channels channels;
  for (const char* name : {"450nm", "900nm", "1000nm"}) channels.push_back(single_channel(name).front());
  write_exr_atlas(model(channels), scratch / "x.exr", paper());
  const Opened read = open_brdf(scratch / "x.exr");
  REQUIRE(read.brdf->channels().size() == 3);
  CHECK(read.brdf->channels()[0].name == "450nm");
  CHECK(*read.brdf->channels()[2].wavelength_in_nm == 1000);
}

TEST_CASE("Attributes that do not fit the picture are refused") {
  const test::TemporaryFolder scratch;
  ExrImage image{2, 4, {{"Y", std::vector<float>(8, 1.0F)}}, {}};
  const auto faults = [&](const char* right, const char* tiles) {
    image.attributes = {{"atlas", "1"}, {"coordinates", "spherical"}, {"right_deg", right}, {"down_deg", "0 45"}, {"tiles_deg", tiles}};
    write_exr_image(image, scratch / "x.exr");
    return faults_of([&] { open_brdf(scratch / "x.exr"); });
  };
  CHECK(faults("0 45", "0 180").empty());
  CHECK(faults("0 45", "0 90 180").find("2 x 4 pixels") != std::string::npos);
  CHECK(faults("45 0", "0 x").find("tiles_deg") != std::string::npos);
  CHECK(faults("45 0", "0 180").find("right_deg") != std::string::npos);
  image.channels[0].second[3] = INFINITY;
  CHECK(faults("0 45", "0 180").find("pixel 3") != std::string::npos);
}

TEST_CASE("No damaged atlas does more than raise an error") {
  const test::TemporaryFolder scratch;
  ExrImage image{2, 4, {{"Y", {1, 2, 3, 4, 5, 6, 7, 8}}}, {}};
  image.attributes = {{"atlas", "1"}, {"coordinates", "spherical"}, {"right_deg", "0 45"}, {"down_deg", "0 45"}, {"tiles_deg", "0 180"}};
  write_exr_image(image, scratch / "seed");
  const std::string seed = test::read_file(scratch / "seed");
  const std::string letters = std::string("0123456789 .gonio") + std::string("\0\1\2\xff", 4);
  const auto [read, refused] = test::read_damaged({seed}, letters, 20260710, 3000, [&](const std::string& bytes) {
    const Opened opened = open_exr_atlas(scratch.file("damaged", bytes), {});
    opened.dataset->require_consistent();
  });
  CHECK(read > 50);
  CHECK(refused > 500);
}
