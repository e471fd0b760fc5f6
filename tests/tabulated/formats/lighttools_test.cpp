// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/lighttools.hpp"

#include <cmath>
#include <random>

#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::replaced;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

const std::string header =
    "Symmetry\tAsymmetric\nSpectralContent\tMonochrome\nScatterAzimuth\t3\n0\t90\t270\nScatterRadial\t2\n0\t40\n\nDataBegin\n";
const std::string block = "AOI\t30\nPOI\t0\nSide\tFront\nWavelength\t550\nScatterType\tBRDF\nTIS\t0.1\n1\t2\n1\t3\n1\t4\n";

Dataset read(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder scratch;
  return *open_brdf(scratch.file("file.bsdf", text), options).dataset;
}

}  // namespace

TEST_CASE("Outgoing angles are absolute, the light comes from azimuth 90") {
  const Dataset data = read(header + block + "DataEnd\n");
  REQUIRE(data.size() == 4);  // the normal once
  CHECK(data.channels[0].wavelength_in_nm == 550);
  CHECK(data.symmetry.isotropic);
  CHECK(data.f[0] == std::vector<double>{1, 2, 3, 4});
  CHECK(data.angles[2].phi_o.degrees() - data.angles[2].phi_i.degrees() == 0);    // 3: on the way back
  CHECK(data.angles[3].phi_o.degrees() - data.angles[3].phi_i.degrees() == 180);  // 4: specular
}

TEST_CASE("Wavelengths and tristimulus values become channels; two sides or kinds of scatter have to be chosen from") {
  const Dataset two = read(header + block + replaced(block, "550", "650") + "DataEnd\n");
  CHECK(two.channels.size() == 2);
  CHECK(two.channels[1].name == "650nm");
  std::string xyz;
  for (const char* tris : {"TrisZ", "TrisX", "TrisY"}) xyz += replaced(block, "TIS", std::string("TristimulusValue\t") + tris + "\nTIS");
  CHECK(read(replaced(header, "Monochrome", "XYZ") + xyz + "DataEnd\n").channels[2].name == "Z");
  const std::string both = header + block + replaced(block, "BRDF", "BTDF") + "DataEnd\n";
  CHECK(faults_of([&] { read(both); }).find("--assume scatter=BRDF or BTDF") != std::string::npos);
  ReadOptions options;
  options.assume["scatter"] = "BTDF";
  const Dataset through = read(both, options);
  CHECK(through.side == Side::transmission);
  CHECK(through.angles[3].theta_o.degrees() == 140);
  CHECK(faults_of([&] { read(header + block + replaced(block, "Front", "Back") + "DataEnd\n"); }).find("--assume side=front or back") !=
        std::string::npos);
}

TEST_CASE("A model written for LightTools reads back; written again the file is the same") {
  const TemporaryFolder scratch;
  const Opened model = test::source_of_model("phong", single_channel("value"), {{0.3, 0.2, 20}});
  const ExportNotes notes = write_lighttools(model, scratch / "a.bsdf", {});
  CHECK(notes.n_unknown == 0);
  const Opened back = open_brdf(scratch / "a.bsdf");
  CHECK(back.format == "lighttools");
  for (std::size_t k = 0; k < back.dataset->size(); ++k) {
    const GonioAngles& pose = back.dataset->angles[k];
    const double exact = model.brdf->eval(pose.wi(), pose.wo())[0];
    REQUIRE(std::fabs(back.dataset->f[0][k] - exact) <= 1e-6 * exact);
  }
  CHECK(test::mean_error(*back.brdf, *model.brdf) < 0.03);
  write_lighttools(back, scratch / "b.bsdf", {});
  const Dataset again = read_lighttools(scratch / "b.bsdf", {});
  CHECK(again.f == back.dataset->f);
  CHECK(faults_of([&] {
          write_lighttools(test::source_of_model("ward-anisotropic", single_channel("value"), {{0, 1, 0.1, 0.3}}), scratch / "c", {});
        }).find("anisotropic") != std::string::npos);
}

TEST_CASE("The faults of a LightTools file are named") {
  const auto faults = [](const std::string& what, const std::string& by) {
    return faults_of([&] { read(replaced(header + block + "DataEnd\n", what, by)); });
  };
  CHECK(faults("AOI\t30", "AOI\t100").find("AOI 100") != std::string::npos);
  CHECK(faults("1\t2\n", "1\tx\n").find("'x'") != std::string::npos);
  CHECK(faults("1\t4\nDataEnd", "1\nDataEnd").find("'DataEnd'") != std::string::npos);
  CHECK(faults("DataEnd\n", "").find("the end of the file") != std::string::npos);
  CHECK(faults("ScatterRadial\t2", "ScatterRadial\t200000000").find("200000000 radial angles") != std::string::npos);
  CHECK(faults("DataEnd\n", block + "DataEnd\n").find("a second time") != std::string::npos);
  CHECK(faults("DataEnd\n", replaced(block, "POI\t0", "POI\t45") + "DataEnd\n").find("POI 45") != std::string::npos);
}

TEST_CASE("No damaged LightTools file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n#AOIPSideTIS") + std::string("\0\xff", 2);
  const std::string seed = header + block + replaced(block, "30", "50") + "DataEnd\n";
  const auto [read_count, refused] = test::read_damaged({seed}, letters, 20260712, 5000, [&](const std::string& bytes) {
    read_lighttools(scratch.file("damaged", bytes), {}).require_consistent();
  });
  CHECK(read_count > 50);
  CHECK(refused > 500);
}
