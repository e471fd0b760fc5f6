// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/abg.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

const std::string text =
    "# a comment\nNAME\tblack\nWAVE\t0.6328\nALL\t0.01\t0.001\t2\nANGLE\t0\t0.02\t0.001\t1.5\nANGLE\t60\t0.04\t0.003\t2.5\n";

Opened open(const std::string& content) {
  const TemporaryFolder scratch;
  return open_brdf(scratch.file("file.abg", content));
}

std::string replaced(std::string content, const std::string& what, const std::string& by) {
  return content.replace(content.find(what), what.size(), by);
}

}  // namespace

TEST_CASE("A, B and g come back from values that obey them, with noise within its size") {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.05);
  for (const AbgParameters truth : {AbgParameters{0.01, 1e-4, 2.2}, AbgParameters{3, 0.5, 1.2}, AbgParameters{1e-5, 1e-9, 3}}) {
    std::vector<double> x, f, noisy;
    for (int k = 0; k < 200; ++k) {
      x.push_back(std::pow(10, -4 + 4.2 * k / 199.0));
      f.push_back(truth.at(x.back()));
      noisy.push_back(f.back() * std::exp(noise(random)));
    }
    const AbgFit fit = fit_abg(x, f);
    INFO("B " << truth.b << " found " << fit.parameters.b);
    CHECK(std::fabs(fit.parameters.a / truth.a - 1) < 1e-6);
    CHECK(std::fabs(fit.parameters.b / truth.b - 1) < 1e-6);
    CHECK(std::fabs(fit.parameters.g - truth.g) < 1e-6);
    CHECK(fit.rms_log < 1e-7);
    CHECK(std::fabs(fit_abg(x, noisy).rms_log - 0.05) < 0.01);
  }
}

TEST_CASE("A constant needs no g; fewer than four positive values are refused") {
  const std::vector<double> x{0, 0.1, 0.2, 0.5, 1}, same(5, 0.3), few{1, 1, 0, -1, std::nan("")};
  const AbgFit fit = fit_abg(x, same);
  for (const double at : x) CHECK(std::fabs(fit.parameters.at(at) - 0.3) < 1e-6);
  CHECK(faults_of([&] { fit_abg(x, few); }).find("2 positive ones") != std::string::npos);
}

TEST_CASE("Between incidences A, B and g are linear in the cosine, beyond them constant") {
  const Opened opened = open(text);
  CHECK(opened.format == "abg");
  CHECK(opened.brdf->channels()[0].wavelength_in_nm == 632.8);
  const auto specular = [&](double theta) {
    const Direction wi = Direction::spherical(degrees(theta), 0_deg);
    return opened.brdf->eval(wi, Direction::trusted(-wi.x(), -wi.y(), wi.z()))[0];
  };
  CHECK(std::fabs(specular(0) - 20) < 1e-12);
  CHECK(std::fabs(specular(60) - 0.04 / 0.003) < 1e-12);
  CHECK(std::fabs(specular(80) - 0.04 / 0.003) < 1e-12);
  const double middle = std::acos(0.75) * 180 / std::numbers::pi;
  CHECK(std::fabs(specular(middle) - 0.03 / 0.002) < 1e-9);
  const double gap = opened.brdf->eval(Direction(), Direction::spherical(30_deg, 0_deg))[0];
  CHECK(std::fabs(gap - 0.02 / (0.001 + std::pow(0.5, 1.5))) < 1e-9);
}

TEST_CASE("An ABg model is written as the parameters it has, anything else with the error that remains") {
  const TemporaryFolder scratch;
  const Opened model = test::source_of_model("abg", single_channel("value"), {{0, 0.01, 1e-3, 2.2}});
  const ExportNotes notes = write_abg(model, scratch / "a.abg", {});
  const Opened back = open_brdf(scratch / "a.abg");
  const auto& table = dynamic_cast<const AbgTable&>(*back.brdf);
  CHECK(table.rows().size() == 10);
  for (const AbgRow& row : table.rows()) {
    CHECK(std::fabs(row.parameters.a / 0.01 - 1) < 1e-5);
    CHECK(std::fabs(row.parameters.b / 1e-3 - 1) < 1e-5);
    CHECK(std::fabs(row.parameters.g - 2.2) < 1e-5);
  }
  CHECK(test::mean_error(*back.brdf, *model.brdf) < 1e-4);
  CHECK(notes.facts[0].second.find("rms of ln f") == 0);

  const Opened phong = test::source_of_model("phong", single_channel("value"), {{0.3, 0.2, 20}});
  const ExportNotes rough = write_abg(phong, scratch / "b.abg", {});
  double worst = 0;
  for (const auto& [key, words] : rough.facts)
    if (key.starts_with("error at")) worst = std::max(worst, std::stod(words.substr(12)));
  CHECK(worst > 0.01);
  CHECK(worst < 1);
}

TEST_CASE("The faults of an ABg text are named") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { open(replaced(text, what, by)); }); };
  CHECK(faults("ANGLE\t60", "ANGLE\t0").find("ANGLE 0") != std::string::npos);
  CHECK(faults("ANGLE\t60", "ANGLE\t95").find("ANGLE 95") != std::string::npos);
  CHECK(faults("0.003", "-1").find("B -1") != std::string::npos);
  CHECK(faults("0.003", "x").find("'x'") != std::string::npos);
  CHECK(faults("0.6328", "-1").find("WAVE -1") != std::string::npos);
  CHECK(faults("\t2.5\n", "\n").find("the end of the file") != std::string::npos);
  CHECK(faults("ANGLE\t60", "MORE\t60").find("'MORE'") != std::string::npos);
}

TEST_CASE("No damaged ABg text does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n#ANGLEWV") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({text}, letters, 20260714, 4000, [&](const std::string& bytes) {
    const Opened opened = open_abg(scratch.file("damaged", bytes), {});
    REQUIRE(opened.brdf->eval(Direction(), Direction())[0] >= 0);
  });
  CHECK(read > 200);
  CHECK(refused > 500);
}
