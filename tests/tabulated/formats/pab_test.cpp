// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/pab.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/opened_samples.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

const std::string good =
    "#sample_name \"cloth\"\n#format: theta phi BSDF\n#intheta 30\n#inphi 10\n#upphi 90\n0 0 0.5\n45 190 0.25\n60 20 0.125\n";

Opened opened(const std::string& text, const std::map<std::string, std::string>& assume = {}) {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.assume = assume;
  return open_brdf(folder.file("any.name", text), options);
}

std::string faults(const std::string& text) {
  return test::faults_of([&] { opened(text); });
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string changed(const std::string& from, const std::string& to) {
  std::string text = good;
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("A pab file is one incidence: angles in degrees, f without the cosine") {
  const Opened file = opened(good);
  CHECK(file.format == "pab");
  const Dataset& samples = *file.dataset;
  REQUIRE(samples.size() == 3);
  CHECK(samples.angles[1].theta_i.degrees() == 30);
  CHECK(samples.angles[1].phi_i.degrees() == 10);
  CHECK(samples.angles[1].theta_o.degrees() == 45);
  CHECK(samples.angles[1].phi_o.degrees() == 190);
  CHECK(samples.f[0] == std::vector<double>{0.5, 0.25, 0.125});
  CHECK(samples.provenance.at("sample") == "cloth");
}

TEST_CASE("DSF is divided by the cosine; tristimulus values are three channels") {
  const Opened dsf = opened(changed("BSDF", "DSF"));
  CHECK(dsf.dataset->f[0][2] == Approx(0.25).epsilon(1e-14));
  const Opened colour = opened("#colorimetry: CIE-XYZ\n#format: theta phi BSDF\n#incident_angle 30 10\n45 190 0.1 0.2 0.3\n");
  REQUIRE(colour.dataset->channels.size() == 3);
  CHECK(colour.dataset->channels[1].name == "Y");
  CHECK(colour.dataset->f[2][0] == 0.3);
}

TEST_CASE("Light from below is seen with the sample turned over; both sides ask which") {
  const Opened below = opened("#format: theta phi BRDF\n#incident_angle 150 20\n135 200 0.5\n");
  CHECK(below.side == Side::reflection);
  CHECK(below.dataset->angles[0].theta_i.degrees() == 30);
  CHECK(below.dataset->angles[0].phi_i.degrees() == -20);
  CHECK(below.dataset->angles[0].theta_o.degrees() == 45);
  const std::string both = "#format: theta phi DSF\n#incident_angle 30 0\n60 180 0.5\n120 180 0.25\n";
  CHECK(contains(faults(both), "1 rows of reflection and 1 of transmission"));
  const Opened through = opened(both, {{"side", "transmission"}});
  CHECK(through.side == Side::transmission);
  REQUIRE(through.dataset->size() == 1);
  CHECK(through.dataset->f[0][0] == Approx(0.5).epsilon(1e-14));
  CHECK(through.masked.below_horizon == 1);
}

TEST_CASE("Faults of a pab file are named with their lines") {
  CHECK(contains(faults(changed("BSDF", "power")), "any.name:2|'format: theta phi power'"));
  CHECK(contains(faults(changed("#intheta 30\n", "")), "no incident direction"));
  CHECK(contains(faults(changed("#intheta 30", "#intheta x")), "any.name:3|"));
  CHECK(contains(faults(changed("45 190 0.25", "45 190")), "any.name:7|2 numbers"));
  CHECK(contains(faults(changed("45 190 0.25", "45 190 inf")), "'inf'"));
  CHECK(contains(faults(changed("45 190 0.25", "-45 190 1")), "theta -45"));
  CHECK(opened(changed("0.25", "nan")).masked.nan == 1);
}

TEST_CASE("No damaged pab file does more than raise an error") {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.format = "pab";
  const auto [read, refused] = test::read_damaged({good}, "0123456789.,-+e# \nnaif\"", 20260803, 4000,
                                                  [&](const std::string& bytes) { open_brdf(folder.file("m", bytes), options); });
  CHECK(read > 200);
  CHECK(refused > 500);
}

TEST_CASE("Written files hold one incidence each and read back to the same samples") {
  const test::TemporaryFolder folder;
  const auto samples = std::make_shared<Dataset>();
  samples->channels = single_channel("value");
  samples->f = {{0.1, 1.0 / 3, -0.01, std::numeric_limits<double>::quiet_NaN()}};
  samples->angles = {
      {30_deg, 5_deg, 10_deg, 185.5_deg}, {50_deg, 5_deg, 20_deg, 7_deg}, {30_deg, 5_deg, 80_deg, 0_deg}, {30_deg, 5_deg, 81_deg, 0_deg}};
  const ExportNotes notes = write_pab(opened_samples("csv", samples), folder / "m.dat", {});
  REQUIRE(notes.files.size() == 2);
  CHECK(notes.files[1] == folder / "m-002.dat");
  const Opened first = open_brdf(notes.files[0]), second = open_brdf(notes.files[1]);
  REQUIRE(first.dataset->size() == 2);
  CHECK(first.dataset->f[0] == std::vector<double>{0.1, 0.0});
  CHECK(first.dataset->angles[0].phi_o.degrees() == 185.5);
  CHECK(second.dataset->f[0] == std::vector<double>{1.0 / 3});
  CHECK(second.dataset->angles[0].theta_i.degrees() == 50);
}

TEST_CASE("A model is sampled over the full turn; a source without values leaves nothing behind") {
  const test::TemporaryFolder folder;
  Opened source;
  const AnalyticBrdf model("phong", rgb_channels(), {{0.1, 0.3, 20}, {0.2, 0.2, 20}, {0.3, 0.1, 20}});
  source.brdf = std::make_shared<const AnalyticBrdf>(model);
  WriteOptions options;
  options.size = GridSize::paper;
  const ExportNotes notes = write_pab(source, folder / "m.dat", options);
  CHECK(notes.files.size() > 5);
  bool left = false, right = false;
  const Opened read = open_brdf(notes.files[3]);
  for (const GonioAngles& at : read.dataset->angles) (at.phi_o.degrees() > 180 ? left : right) = true;
  CHECK((left && right));
  CHECK(read.dataset->channels.size() == 3);

  Opened empty;
  CHECK_FALSE(test::faults_of([&] { write_pab(empty, folder / "no.dat", options); }).empty());
  CHECK_FALSE(std::filesystem::exists(folder / "no.dat"));
}
