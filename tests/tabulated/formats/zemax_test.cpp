// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/zemax.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "tabulated/total_scatter.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::read_file;
using gonio::test::replaced;
using gonio::test::source_of_model;
using gonio::test::TemporaryFolder;

namespace {

const std::string small =
    "# made for a test\nSource\tMeasured\nSymmetry\tPlaneSymmetrical\nSpectralContent\tMonochrome\nScatterType\tBRDF\n"
    "SampleRotation\t1\n0\nAngleOfIncidence\t2\n10\t30\nScatterAzimuth\t3\n0\t90\t180\nScatterRadial\t3\n0\t20\t70\n\nMonochrome\nDataBegin"
    "\n"
    "TIS\t0.125\n4\t2\t1\n4\t2.5\t1\n4\t3\t9\nTIS\t0.25\n5\t2\t1\n5\t2\t1\n5\t2\t9\nDataEnd\n";

Opened open(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder scratch;
  return open_brdf(scratch.file("file.bsdf", text), options);
}

double at(const Brdf& brdf, double theta_i, double theta_o, double phi_o) {
  return brdf.eval(Direction::spherical(degrees(theta_i), 0_deg), Direction::spherical(degrees(theta_o), degrees(phi_o)))[0];
}

}  // namespace

TEST_CASE("Nodes lie about the specular direction; those beyond the horizon are masked and do not enter the interpolation") {
  const Opened opened = open(small);
  CHECK(opened.format == "zemax");
  REQUIRE(opened.brdf);
  CHECK(opened.brdf->symmetry() == Symmetry{true, true, false});
  CHECK(at(*opened.brdf, 10, 10, 180) == 4);                  // specular
  CHECK(std::fabs(at(*opened.brdf, 10, 10, 0) - 2) < 1e-12);  // 20 degrees towards the normal, past it
  CHECK(std::fabs(at(*opened.brdf, 10, 30, 180) - 3) < 1e-12);
  CHECK(std::fabs(at(*opened.brdf, 20, 20, 180) - 4.5) < 1e-12);  // between two incidences the peak stays specular
  CHECK(std::fabs(at(*opened.brdf, 30, 85, 180) - 2) < 1e-12);    // the node at 100 degrees, 9, is no measurement
  CHECK(std::isnan(at(*opened.brdf, 50, 50, 180)));
  CHECK(opened.masked.below_horizon == 1);
  REQUIRE(opened.dataset);
  CHECK(opened.dataset->size() == 2 * (1 + 3 + 3) - 1);
  CHECK(opened.dataset->provenance.at("zemax_tis_value") == "0.125 0.25");
}

TEST_CASE("A Zemax file is written again with the same numbers, its TIS and its comments") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("a.bsdf", small));
  write_zemax(opened, scratch / "b.bsdf", {});
  CHECK(read_file(scratch / "b.bsdf") == small);
}

TEST_CASE("XYZ, transmission and sample rotations are read; how rotations turn has to be said") {
  const std::string xyz = replaced(small, "Monochrome\nScatter", "XYZ\nScatter");
  const std::string block = small.substr(small.find("DataBegin"));
  const Opened colour = open(replaced(
      xyz.substr(0, xyz.find("Monochrome\nDataBegin")) + "TristimulusX\n" + block + "TristimulusY\n" + block + "TristimulusZ\n" + block,
      "BRDF", "BTDF"));
  CHECK(colour.brdf->channels().size() == 3);
  CHECK(colour.brdf->channels()[1].name == "Y");
  CHECK(colour.dataset->side == Side::transmission);
  CHECK(at(*colour.brdf, 10, 170, 180) == 4);

  std::string turned = replaced(small, "SampleRotation\t1\n0", "SampleRotation\t2\n0 90");
  turned = replaced(turned, "DataEnd", block.substr(10, block.find("DataEnd") - 10) + "DataEnd");
  CHECK(faults_of([&] { open(turned); }).find("--assume rotation=counter-clockwise") != std::string::npos);
  ReadOptions options;
  options.assume["rotation"] = "clockwise";
  const Opened clockwise = open(turned, options);
  CHECK_FALSE(clockwise.brdf->symmetry().isotropic);
  CHECK(clockwise.dataset->angles.back().phi_i.degrees() == 180);
  options.assume["rotation"] = "counter-clockwise";
  CHECK(open(turned, options).dataset->angles.back().phi_i.degrees() == 0);
}

TEST_CASE("What was written from a model reads back as the model: at nodes to single precision, between them within a few per cent") {
  const TemporaryFolder scratch;
  const Opened model = source_of_model("ggx", single_channel("value"), {{0.2, 0.5, 0.5, 0.1}});
  const ExportNotes notes = write_zemax(model, scratch / "ggx.bsdf", {});
  CHECK(notes.n_unknown == 0);
  CHECK(notes.n_below_horizon > 0);
  const Opened back = open_brdf(scratch / "ggx.bsdf");
  const auto& table = dynamic_cast<const ZemaxTable&>(*back.brdf);
  for (std::size_t k = 0; k < back.dataset->size(); ++k) {
    const GonioAngles& pose = back.dataset->angles[k];
    if (pose.theta_o.degrees() > 89.9) continue;
    const double exact = model.brdf->eval(pose.wi(), pose.wo())[0];
    REQUIRE(std::fabs(back.dataset->f[0][k] - exact) <= 1e-6 * exact);
  }
  for (std::size_t i = 0; i < table.grid().incidence_deg.size(); ++i)
    CHECK(std::fabs(table.remarks().tis[0][i] -
                    total_scatter(*model.brdf, degrees(table.grid().incidence_deg[i]), 0_deg, Side::reflection)[0]) < 1e-6);
  CHECK(test::mean_error(*back.brdf, *model.brdf) < 0.01);
}

TEST_CASE("Colour becomes X, Y, Z of linear sRGB; an anisotropic source gets sample rotations that need no answer when read") {
  const TemporaryFolder scratch;
  WriteOptions paper;
  paper.size = GridSize::paper;
  const Opened red = source_of_model("lambert", rgb_channels(), {{0.5}, {0}, {0}});
  const ExportNotes notes = write_zemax(red, scratch / "red.bsdf", paper);
  CHECK_FALSE(notes.lost.empty());
  const auto xyz = open_brdf(scratch / "red.bsdf").brdf->eval(Direction(), Direction());
  CHECK(std::fabs(xyz[0] * std::numbers::pi / 0.5 - 0.4124) < 2e-4);
  CHECK(std::fabs(xyz[1] * std::numbers::pi / 0.5 - 0.2126) < 2e-4);

  const Opened brushed = source_of_model("ward-anisotropic", single_channel("value"), {{0.1, 0.3, 0.1, 0.3}});
  write_zemax(brushed, scratch / "ward.bsdf", paper);
  const Opened back = open_brdf(scratch / "ward.bsdf");
  CHECK_FALSE(back.brdf->symmetry().isotropic);
  for (const double phi : {0.0, 30.0, 90.0, 120.0, 300.0}) {
    const Direction wi = Direction::spherical(30_deg, degrees(phi)), wo = Direction::spherical(30_deg, degrees(phi + 180));
    INFO("azimuth " << phi);
    CHECK(std::fabs(back.brdf->eval(wi, wo)[0] / brushed.brdf->eval(wi, wo)[0] - 1) < 1e-6);
  }
}

TEST_CASE("Values that are unknown or negative are written as 0 and counted") {
  class Awkward final : public Brdf {
   public:
    const Channels& channels() const override { return channels_; }
    Symmetry symmetry() const override { return {true, true, true}; }
    void eval(std::span<const Direction>, std::span<const Direction> wo, std::span<double> f) const override {
      for (std::size_t k = 0; k < wo.size(); ++k)
        f[k] = wo[k].z() > 0.9 ? std::numeric_limits<double>::quiet_NaN() : wo[k].z() > 0.5 ? -1 : 0.5;
    }

   private:
    Channels channels_ = single_channel("value");
  };
  const TemporaryFolder scratch;
  Opened source;
  source.brdf = std::make_shared<const Awkward>();
  const ExportNotes notes = write_zemax(source, scratch / "awkward.bsdf", {});
  CHECK(notes.n_unknown > 0);
  CHECK(notes.n_negative > 0);
  CHECK(notes.lost.size() >= 2);
  const Opened back = open_brdf(scratch / "awkward.bsdf");
  for (const double value : back.dataset->f[0]) REQUIRE((value == 0 || value == 0.5));
}

TEST_CASE("The faults of a Zemax file are named") {
  const auto faults = [](const std::string& what, const std::string& by) { return faults_of([&] { open(replaced(small, what, by)); }); };
  CHECK(faults("PlaneSymmetrical", "Round").find("Symmetry 'Round'") != std::string::npos);
  CHECK(faults("10\t30", "30\t10").find("AngleOfIncidence 10 after 30") != std::string::npos);
  CHECK(faults("10\t30", "10\t91").find("AngleOfIncidence 91") != std::string::npos);
  CHECK(faults("0\t90\t180", "0\t90\t190").find("ScatterAzimuth 190") != std::string::npos);
  CHECK(faults("4\t2\t1", "4\tx\t1").find(":18|'x'") != std::string::npos);
  CHECK(faults("4\t2\t1", "4\tnan\t1").find("'nan'") != std::string::npos);
  CHECK(faults("4\t2\t1", "4\tinf\t1").find("'inf'") != std::string::npos);
  CHECK(faults("4\t2\t1", "4\t2").find("'TIS'") != std::string::npos);
  CHECK(faults("TIS\t0.25\n", "").find("TIS of block 2 of 2") != std::string::npos);
  CHECK(faults("DataEnd\n", "").find("DataEnd") != std::string::npos);
  CHECK(faults("DataEnd\n", "DataEnd\nmore").find("'more'") != std::string::npos);
  CHECK(faults("ScatterRadial\t3", "ScatterRadial\t9999999999").find("9999999999 radial angles") != std::string::npos);
  CHECK(faults("ScatterRadial\t3", "ScatterRadial\t-3").find("radial angles") != std::string::npos);
  CHECK(faults("Symmetry\tPlaneSymmetrical\n", "").find("no Symmetry") != std::string::npos);
}

TEST_CASE("No damaged Zemax file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE\t \r\n#TISDataEnd") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({small}, letters, 20260711, 5000, [&](const std::string& text) {
    const auto table = read_zemax(scratch.file("damaged.bsdf", text), {});
    table->samples().require_consistent();
  });
  CHECK(read > 200);
  CHECK(refused > 500);
}

TEST_CASE(
    "The tables of the owners of the RT-300S are read and written unchanged; their TIS is half the integral of f without its cosine") {
  const TemporaryFolder scratch;
  for (const std::string name : {"AnoBlackEC1onAlum", "AnoBlackNiTEonSteel"}) {
    const auto path = test::measured_data("loft_rt300s/processed_zemax/" + name + ".bsdf");
    if (!path) return;
    const Opened opened = open_brdf(*path);
    CHECK(opened.format == "zemax");
    const auto& table = dynamic_cast<const ZemaxTable&>(*opened.brdf);
    CHECK(table.grid().size() == 4 * 19 * 12);
    write_zemax(opened, scratch / "again.bsdf", {});
    const auto again = read_zemax(scratch / "again.bsdf", {});
    CHECK(again->values() == table.values());
    CHECK(again->remarks().tis == table.remarks().tis);
    CHECK(again->remarks().comments == table.remarks().comments);
    CHECK(again->grid().radial_deg == table.grid().radial_deg);

    // Their own sum: the mean of four corners times the mean of two sines, over the half turn of azimuths of the file (which is where
    // the factor of two is lost), no cosine. They take a specular spot of 0.3 degrees out, which is less than these digits.
    const SpecularGrid& grid = table.grid();
    for (std::size_t i = 0; i < 4; ++i) {
      double sum = 0;
      for (std::size_t a = 0; a + 1 < grid.azimuth_deg.size(); ++a)
        for (std::size_t r = 0; r + 1 < grid.radial_deg.size(); ++r) {
          const auto value = [&](std::size_t da, std::size_t dr) { return table.values()[0][grid.index(0, i, a + da, r + dr)]; };
          const Angle low = degrees(grid.radial_deg[r]), high = degrees(grid.radial_deg[r + 1]);
          sum += (value(0, 0) + value(0, 1) + value(1, 0) + value(1, 1)) / 4 * (low.sin() + high.sin()) / 2 * (high - low).radians() *
                 degrees(grid.azimuth_deg[a + 1] - grid.azimuth_deg[a]).radians();
        }
      INFO(name << " incidence " << grid.incidence_deg[i]);
      CHECK(std::fabs(sum / table.remarks().tis[0][i] - 1) < 1e-3);
      const double ours = total_scatter(table, degrees(grid.incidence_deg[i]), 0_deg, Side::reflection)[0];
      CHECK(std::fabs(ours / table.remarks().tis[0][i] - 1) > 0.01);
    }
  }
}
