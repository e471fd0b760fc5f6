// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/fred.hpp"

#include <cmath>
#include <random>

#include "tabulated/opened_samples.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::replaced;
using gonio::test::TemporaryFolder;

namespace {

const std::string in_plane =
    "type bsdf_data\nformat angles=deg bsdf=value scale=2\n0 0\n-30 0 0.5\n0 0 1\n30 0 0.5\n15 0\n-20\t0\t0.25\n15,0,4\n";

Dataset read(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("file.txt", text), options);
  CHECK(opened.format == "fred");
  return *opened.dataset;
}

}  // namespace

TEST_CASE("FRED names the specular direction: light comes from the other side; negative zenith angles are across the normal") {
  const Dataset data = read(in_plane);
  REQUIRE(data.size() == 5);
  CHECK(data.f[0] == std::vector<double>{1, 2, 1, 0.5, 8});
  CHECK(data.symmetry.isotropic);
  const GonioAngles& back = data.angles[3];
  CHECK(back.theta_i.degrees() == 15);
  CHECK(back.theta_o.degrees() == 20);
  CHECK(back.phi_o.degrees() - back.phi_i.degrees() == 0);
  const GonioAngles& specular = data.angles[4];
  CHECK(std::fabs(specular.phi_o.degrees() - specular.phi_i.degrees()) == 180);
}

TEST_CASE("Direction cosines and logarithms are the same data written otherwise; transmission has to be said") {
  const Dataset cosines = read("type bsdf_data\nformat angles=sin bsdf=log scale=1\n0 0.5\n0 0.5 -1\n0.5 0 2\n");
  CHECK(std::fabs(cosines.angles[0].theta_i.degrees() - 30) < 1e-12);
  CHECK(std::fabs(cosines.angles[0].theta_o.degrees() - 30) < 1e-12);
  CHECK(std::fabs(cosines.f[0][0] - 0.1) < 1e-15);
  CHECK(std::fabs(cosines.f[0][1] - 100) < 1e-12);
  CHECK(std::fabs(cosines.angles[1].phi_o.degrees() - 90) < 1e-12);
  ReadOptions options;
  options.assume["side"] = "transmission";
  CHECK(read(in_plane, options).angles[4].theta_o.degrees() == 165);
}

TEST_CASE("Samples in plane are written as signed angles and read back bit for bit in single precision") {
  const TemporaryFolder scratch;
  const Opened source = open_brdf(scratch.file("a.txt", in_plane));
  const ExportNotes notes = write_fred(source, scratch / "b.txt", {});
  CHECK(test::read_file(scratch / "b.txt") ==
        "type bsdf_data\nformat angles=deg bsdf=value scale=1\n0\t0\n-30\t0\t1\n0\t0\t2\n30\t0\t1\n15\t0\n-20\t0\t0.5\n15\t0\t8\n");
  CHECK(notes.n_nodes == 5);
  const Opened again = open_brdf(scratch / "b.txt");
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(angle_between(again.dataset->angles[k].wo(), source.dataset->angles[k].wo()).degrees() < 1e-9);
    CHECK(again.dataset->f[0][k] == source.dataset->f[0][k]);
  }
}

TEST_CASE("A model written for FRED reads back: at samples to single precision, between them within a few per cent") {
  const TemporaryFolder scratch;
  const Opened model = test::source_of_model("phong", rgb_channels(), {{0.3, 0.2, 20}, {0.3, 0.2, 20}, {0.3, 0.2, 20}});
  const ExportNotes notes = write_fred(model, scratch / "a.txt", {});
  CHECK(notes.lost.size() == 1);  // colour
  const Opened back = open_brdf(scratch / "a.txt");
  for (std::size_t k = 0; k < back.dataset->size(); ++k) {
    const GonioAngles& pose = back.dataset->angles[k];
    const double exact = model.brdf->eval(pose.wi(), pose.wo())[0];
    REQUIRE(std::fabs(back.dataset->f[0][k] - exact) <= 1e-6 * exact);
  }
}

TEST_CASE("What is not positive is left out and said") {
  Dataset samples;
  samples.channels = single_channel("value");
  samples.angles = {{10_deg, 0_deg, 10_deg, 180_deg}, {10_deg, 0_deg, 20_deg, 180_deg}, {10_deg, 0_deg, 20_deg, 90_deg}};
  samples.f = {{1, 0, -1}};
  samples.symmetry.isotropic = true;
  const TemporaryFolder scratch;
  const ExportNotes notes = write_fred(opened_samples("csv", std::make_shared<const Dataset>(samples)), scratch / "a.txt", {});
  CHECK(notes.lost.size() == 1);
  CHECK(read_fred(scratch / "a.txt", {}).size() == 1);
}

TEST_CASE("The faults of a FRED file are named") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { read(replaced(in_plane, what, by)); }); };
  CHECK(faults("angles=deg", "angles=rad").find("'angles=rad'") != std::string::npos);
  CHECK(faults("bsdf=value ", "").find("no bsdf=") != std::string::npos);
  CHECK(faults("scale=2", "scale=0").find("scale= and a positive number") != std::string::npos);
  CHECK(faults("0 0\n-30", "-30").find("before any specular direction") != std::string::npos);
  CHECK(faults("30 0 0.5", "95 0 0.5").find("95 0") != std::string::npos);
  CHECK(faults("0 0 1", "0 0 x").find("'x'") != std::string::npos);
  CHECK(faults("0 0 1", "0 0 1 7").find("4 numbers") != std::string::npos);
  CHECK(faults_of([&] { read("type bsdf_data\n"); }).find("the end of the file") != std::string::npos);
  CHECK(faults_of([&] { read("type bsdf_data\nformat angles=deg bsdf=value\n0 0\n"); }).find("no sample") != std::string::npos);
}

TEST_CASE("A file that ends after a specular direction is not whole") {
  const TemporaryFolder scratch;
  const std::string whole = "type bsdf_data\nformat angles=deg bsdf=value scale=1\n0 0\n10 0 0.5\n20 0\n30 0 0.4\n";
  CHECK(open_brdf(scratch.file("a.txt", whole)).dataset->size() == 2);
  CHECK(faults_of([&] { open_brdf(scratch.file("b.txt", whole.substr(0, whole.size() - 5))); }).find("without samples") !=
        std::string::npos);
}

TEST_CASE("No damaged FRED file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n#,=format") + std::string("\0\xff", 2);
  const auto [read_count, refused] = test::read_damaged({in_plane}, letters, 20260713, 5000, [&](const std::string& bytes) {
    read_fred(scratch.file("damaged", bytes), {}).require_consistent();
  });
  CHECK(read_count > 200);
  CHECK(refused > 500);
}
