// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/openmaterial.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/samples_to_write.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::faults_of;

namespace {

Opened model(Channels channels) {
  Opened out;
  out.format = "test";
  std::vector<std::vector<double>> parameters;
  for (std::size_t c = 0; c < channels.size(); ++c) parameters.push_back({0.1 + 0.1 * static_cast<double>(c), 0.3, 40});
  out.brdf = std::make_shared<AnalyticBrdf>("phong", channels, parameters);
  return out;
}

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

Opened open(const std::string& text, const ReadOptions& options = {}) {
  const test::TemporaryFolder scratch;
  return open_brdf(scratch.file("x.json", text), options);
}

std::string with(const std::string& rows) {
  return R"({"metadata": {}, "brdf": {"wavelengths": [5.5e-7], "lookupTable": [)" + rows + "]}}";
}

}  // namespace

TEST_CASE("A model written as a look-up table meets the rules and comes back at its nodes") {
  const test::TemporaryFolder scratch;
  for (const Channels& channels : {rgb_channels(), single_channel("value")}) {
    const Opened source = model(channels);
    write_openmaterial(source, scratch / "x.json", paper());
    const Json document = parse_json(read_file(scratch / "x.json"), "x");
    for (const Fault& fault : gonio::faults_of(document, Schema::openmaterial_brdf, "")) FAIL_CHECK(fault.where << " " << fault.found);
    const Opened read = open_brdf(scratch / "x.json");
    CHECK(read.format == "openmaterial-json");
    CHECK(read.dataset->channels == channels);
    ExportNotes notes;
    const auto sampled = with_both_sides(samples_to_write(source, paper(), notes));
    REQUIRE(read.dataset->size() == sampled->size());
    // Angles in radians round once.
    constexpr double rounding = 1e-12;
    for (std::size_t k = 0; k < read.dataset->size(); k += 7) {
      const GonioAngles& at = read.dataset->angles[k];
      CHECK(read.dataset->f[0][k] == Approx(source.brdf->eval(at.wi(), at.wo())[0]).epsilon(rounding));
    }
    // Written again from its own reading it is the same file.
    write_openmaterial(read, scratch / "again.json", paper());
    const bool same = read_file(scratch / "again.json") == read_file(scratch / "x.json");
    CHECK(same);
  }
}

TEST_CASE("Wavelengths become channels, solid angles the aperture, null a masked row") {
  const Opened read = open(R"({"metadata": {"openMaterial3dVersion": "1.0.0"}, "brdf": {"wavelengths": [4e-7, 5.5e-7],
    "receiverSolidAngles": [{"wavelength": 4e-7, "solidAngle": 0.001}, {"wavelength": 5.5e-7, "solidAngle": 0.001}],
    "lookupTable": [[4e-7, 0.5, 0.25, 3, 0.1], [5.5e-7, 0.5, 0.25, 3, 0.2], [5.5e-7, 0.5, 0.3, 3, null]]}})");
  REQUIRE(read.dataset->channels.size() == 2);
  CHECK(read.dataset->channels[1].name == "550nm");
  CHECK(read.dataset->size() == 1);
  CHECK(read.dataset->f[1][0] == 0.2);
  CHECK(read.masked.nan == 1);
  CHECK(read.dataset->symmetry.isotropic);
  const double half_angle = *read.dataset->apertures.receiver_half_angle_deg * std::numbers::pi / 180;
  CHECK(2 * std::numbers::pi * (1 - std::cos(half_angle)) == Approx(0.001).epsilon(1e-9));
}

TEST_CASE("Where the mirror direction is can be said") {
  const std::string rows = with("[5.5e-7, 0.5, 0.25, 0, 0.1]");
  CHECK(open(rows).dataset->angles[0].phi_o.radians() == 0);
  ReadOptions options;
  options.assume["specular_azimuth_deg"] = "0";
  CHECK(open(rows, options).dataset->angles[0].phi_o.degrees() == Approx(180));
  options.assume["specular_azimuth_deg"] = "90";
  CHECK(faults_of([&] { open(rows, options); }).find("usage|") == 0);
}

TEST_CASE("Every fault of the table is named at once, and rows out of order") {
  const std::string values = faults_of([] { open(with("[5.5e-7, 30, 0.25, 0, 0.1], [5.5e-7, 0.5, 0.25, 7, -0.1], [1]")); });
  for (const char* where : {"lookupTable/0/1|", "lookupTable/1/3|", "lookupTable/1/4|", "lookupTable/2|"}) {
    INFO(where << " in " << values);
    CHECK(values.find(where) != std::string::npos);
  }
  CHECK(faults_of([] { open(with("[5.5e-7, 0.5, 0.3, 0, 0.1], [5.5e-7, 0.5, 0.25, 0, 0.1]")); }).find("lookupTable/1|") !=
        std::string::npos);
  CHECK(faults_of([] { open(with("[5.5e-7, 0.5, 0.3, 0, null]")); }).find("no row with a value") != std::string::npos);
}

TEST_CASE("An anisotropic source and one of several unknown channels are refused") {
  const test::TemporaryFolder scratch;
  Dataset data;
  data.channels = single_channel("value");
  data.angles = {{30_deg, 0_deg, 40_deg, 180_deg}, {30_deg, 90_deg, 40_deg, 180_deg}};
  data.f = {{1, 2}};
  Opened source;
  source.dataset = std::make_shared<const Dataset>(data);
  CHECK(faults_of([&] { write_openmaterial(source, scratch / "x", {}); }).find("isotropic") != std::string::npos);
  data.symmetry.isotropic = true;
  data.channels = {single_channel("x").front(), single_channel("y").front()};
  data.f.push_back(data.f[0]);
  source.dataset = std::make_shared<const Dataset>(data);
  CHECK(faults_of([&] { write_openmaterial(source, scratch / "x", {}); }).find("2 channels") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "x"));
}

TEST_CASE("No damaged look-up table does more than raise an error") {
  const test::TemporaryFolder scratch;
  const std::string seed = with("[5.5e-7, 0.5, 0.25, 0, 0.1], [5.5e-7, 0.5, 0.25, 3.1, 0.2], [6e-7, 0.5, 0.25, 0, null]");
  const std::string letters = std::string("0123456789.-+eE\"{}[]:, \nnull") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({seed}, letters, 20260707, 1500, [&](const std::string& text) {
    const Opened opened = open_openmaterial(scratch.file("damaged.json", text), {});
    opened.dataset->require_consistent();
    REQUIRE(opened.dataset->size() > 0);
  });
  CHECK(read > 15);
  CHECK(refused > 500);
}
