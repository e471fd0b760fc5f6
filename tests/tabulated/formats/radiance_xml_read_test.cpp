// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <random>

#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/klems_table.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/window_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::two_rings;
using test::window_text;
using test::WindowTextBlock;

namespace {

/// 0, 1, 2, ... of 5 x 5.
std::string counting(double step = 1) {
  std::string out;
  for (int k = 0; k < 25; ++k) out += fmt::format("{} ", step * k);
  return out;
}

Opened opened(const std::string& text, const std::map<std::string, std::string>& assume = {}) {
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.assume = assume;
  return open_brdf(folder.file("any.name", text), options);
}

std::string faults(const std::string& text, const std::map<std::string, std::string>& assume = {}) {
  return test::faults_of([&] { opened(text, assume); });
}

std::string said(const Opened& file, const std::string& key) {
  for (const auto& [name, words] : file.info)
    if (name == key) return words;
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const Direction down_x = Direction::spherical(60_deg, 0_deg), up_x = Direction::spherical(60_deg, 180_deg),
                up_y = Direction::spherical(60_deg, 90_deg), minus_y = Direction::spherical(60_deg, -90_deg);

}  // namespace

TEST_CASE("In Columns the incident patch runs fastest, in Rows the outgoing one; the incident patch is that of the opposite azimuth") {
  const Opened columns = opened(window_text("Columns", two_rings, {{.data = counting()}}));
  const Opened rows = opened(window_text("Rows", two_rings, {{.data = counting()}}));
  CHECK(columns.format == "radiance-xml");
  // Light from +x falls into patch 3 (its shadow, 180°); seen from +y is patch 2.
  CHECK(columns.brdf->eval(down_x, up_y)[0] == 2 * 5 + 3);
  CHECK(rows.brdf->eval(down_x, up_y)[0] == 3 * 5 + 2);
  // Mirror directions lie on the diagonal.
  CHECK(columns.brdf->eval(down_x, up_x)[0] == 3 * 5 + 3);
  CHECK(columns.brdf->eval(Direction(), Direction())[0] == 0);
  CHECK(columns.brdf->eval(down_x, Direction::spherical(120_deg, 0_deg))[0] == 0);
}

TEST_CASE("Patch centres are the samples, with the values of the patches") {
  const Opened file = opened(window_text("Columns", two_rings, {{.data = counting()}}));
  REQUIRE(file.observations->block_count() == 1);
  const ObservationBlock block = file.observations->block(0);
  REQUIRE(block.size == 25);
  std::vector<GonioAngles> angles;
  file.observations->angles(0, angles);
  for (std::size_t k = 0; k < block.size; ++k) CHECK(file.brdf->eval(angles[k].wi(), angles[k].wo())[0] == block.f[0][k]);
}

TEST_CASE("The block is chosen by kind and side; the default is reflection, back first, and info says so") {
  const std::string text = window_text("Columns", two_rings,
                                       {{.direction = "Transmission Front", .data = counting(4)},
                                        {.direction = "Reflection Front", .data = counting(2)},
                                        {.direction = "Reflection Back", .data = counting(1)}});
  const Opened file = opened(text);
  CHECK(file.side == Side::reflection);
  CHECK(file.brdf->eval(down_x, up_y)[0] == 13);
  CHECK(contains(said(file, "block"), "Reflection Back of Visible (default"));
  CHECK(said(file, "missing blocks") == "Transmission Back");
  CHECK(said(file, "holds") == "f (BSDF), cosine not included");
  // The front is seen with the sheet turned over its x axis: +y is -y of the file, patch 4.
  const Opened front = opened(text, {{"side", "front"}});
  CHECK(front.brdf->eval(down_x, up_y)[0] == 2 * (4 * 5 + 3));
  CHECK(front.brdf->eval(down_x, minus_y)[0] == 2 * (2 * 5 + 3));
  const Opened through = opened(text, {{"kind", "transmission"}});
  CHECK(through.side == Side::transmission);
  CHECK(through.brdf->eval(down_x, up_y)[0] == 0);
  CHECK(through.brdf->eval(down_x, Direction::spherical(120_deg, 90_deg))[0] == 4 * (4 * 5 + 3));
  std::vector<GonioAngles> angles;
  through.observations->angles(0, angles);
  for (std::size_t k = 0; k < angles.size(); ++k)
    CHECK(through.brdf->eval(angles[k].wi(), angles[k].wo())[0] == through.observations->block(0).f[0][k]);

  CHECK(contains(faults(text, {{"kind", "transmission"}, {"side", "back"}}), "as --assume wants it"));
  CHECK(contains(faults(text, {{"side", "left"}}), "front or back"));
  CHECK(contains(faults(text, {{"wavelength", "Solar"}}), "a block of Solar"));
}

TEST_CASE("A file with transmission alone is read as transmission") {
  const Opened file = opened(window_text("Columns", two_rings, {{.direction = "Transmission Back", .data = counting()}}));
  CHECK(file.side == Side::transmission);
  CHECK(said(file, "missing blocks") == "Reflection Front, Reflection Back, Transmission Front");
}

TEST_CASE("Visible with CIE-X and CIE-Z is colour; one of them alone is not") {
  std::string equal;
  for (int k = 0; k < 25; ++k) equal += "0.25 ";
  const Opened grey = opened(
      window_text("Columns", two_rings, {{.wavelength = "CIE-X", .data = equal}, {.data = equal}, {.wavelength = "CIE-Z", .data = equal}}));
  CHECK(grey.brdf->channels() == rgb_channels());
  for (const double value : grey.brdf->eval(down_x, up_y)) CHECK(value == Approx(0.25).epsilon(1e-12));
  CHECK(contains(said(grey, "colour"), "Radiance's primaries"));
  const Opened half = opened(window_text("Columns", two_rings, {{.data = equal}, {.wavelength = "CIE-X", .data = equal}}));
  CHECK(half.brdf->channels()[0].name == "Y");
}

TEST_CASE("Commas may separate and one may follow; excerpts of the first patches leave the rest unknown") {
  const Opened file = opened(window_text("Columns", two_rings, {{.data = "\n 1, 2,\n 3, 4,\n"}}));
  CHECK(file.brdf->eval(Direction(), Direction())[0] == 1);
  CHECK(file.brdf->eval(up_x, Direction())[0] == 2);
  CHECK(std::isnan(file.brdf->eval(down_x, Direction())[0]));
  CHECK(file.masked.missing == 21);
  CHECK(file.observations->block(0).size == 4);
  // Not square, or not line by line: truncated, not an excerpt.
  CHECK(contains(faults(window_text("Columns", two_rings, {{.data = "1 2 3 4"}})), "4 values in Reflection Back|5 x 5"));
  CHECK(contains(faults(window_text("Columns", two_rings, {{.data = "1 2\n3 4\n5"}})), "5 values"));
  CHECK(contains(faults(window_text("Columns", two_rings, {{.data = counting() + "26"}})), "26 values"));
}

TEST_CASE("Negative values are read as 0, as Radiance does, and counted") {
  const Opened file = opened(window_text("Columns", two_rings, {{.data = "-1 " + counting().substr(2)}}));
  CHECK(file.brdf->eval(Direction(), Direction())[0] == 0);
  CHECK(contains(said(file, "negative values"), "1,"));
}

TEST_CASE("Trees of rank 3 and 4 are read, with colour") {
  const std::string basis = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";
  const Opened three = opened(window_text("TensorTree3", "", {{.data = "{ {1} {0} {2} {0} {3} {0} {4} {0} }", .basis = basis}}));
  CHECK(three.brdf->symmetry().isotropic);
  CHECK(three.brdf->eval(up_x, Direction::spherical(60_deg, 10_deg))[0] == 4);  // (x1, x2) both in the upper half
  CHECK(three.brdf->eval(up_x, Direction::spherical(60_deg, -10_deg))[0] == 2);
  CHECK(three.observations->block(0).size == 4);
  const Opened four = opened(window_text("TensorTree4", "",
                                         {{.data = "{ 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 }", .basis = basis},
                                          {.wavelength = "CIE-u", .data = "{0.2105263}", .basis = basis},
                                          {.wavelength = "CIE-v", .data = "{0.4736842}", .basis = basis}}));
  CHECK(four.brdf->channels() == rgb_channels());
  // wi from -x-y: (x0, x1) both upper; wo towards +x-y: x2 upper, x3 lower.
  const auto f = four.brdf->eval(Direction::spherical(60_deg, 215_deg), Direction::spherical(60_deg, -35_deg));
  for (const double value : f) CHECK(value == Approx(8 + 4 + 2).epsilon(1e-5));
  CHECK(contains(faults(window_text("TensorTree3", "", {{.data = "{1}"}})), "AngleBasis ''|LBNL/Shirley-Chiu"));
  CHECK(contains(faults(window_text("TensorTree3", "", {{.data = "{1 2}", .basis = basis}})), "2 values in a node"));
}

TEST_CASE("Damage is refused with its line, all faults of a file at once") {
  const std::string good = window_text("Columns", two_rings, {{.data = counting()}});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return faults(text);
  };
  CHECK(contains(changed("Columns", "Diagonals"), "any.name:6|IncidentDataStructure 'Diagonals'"));
  CHECK(contains(changed("Reflection Back", "Absorption"), "WavelengthDataDirection 'Absorption'"));
  CHECK(contains(changed("BTDF", "BRDF cos"), "ScatteringDataType 'BRDF cos'"));
  CHECK(contains(changed("<UpperTheta>30", "<UpperTheta>95"), "ThetaBounds 0 to 95"));
  CHECK(contains(changed("<nPhis>4", "<nPhis>1e9"), "nPhis 1000000000"));
  CHECK(contains(changed("<nPhis>4", "<nPhis>-4"), "nPhis -4"));
  CHECK(contains(changed("<ColumnAngleBasis>two", "<ColumnAngleBasis>no"), "ColumnAngleBasis 'no rings'"));
  CHECK(contains(changed("12 13", "12 nan"), "any.name:16|'nan' at byte "));
  CHECK(contains(changed("12 13", "12,,13"), "',' at byte "));
  CHECK(contains(changed("</Layer>", ""), "well-formed XML"));
  CHECK(contains(changed("<Layer>", "<Layer/><Layer>"), "several layers"));
  CHECK(contains(changed("<Material>", "<!DOCTYPE a [<!ENTITY b 'c'>]><Material>"), "a document type"));
  CHECK(contains(changed("two rings</AngleBasisName>", "LBNL/Klems Full</AngleBasisName>"), "defined otherwise than it is"));
  const std::string several = faults(window_text(
      "Columns", two_rings, {{.data = "1 2"}, {.direction = "nowhere", .data = "1"}, {.direction = "Reflection Front", .data = ""}}));
  CHECK(contains(several, "'nowhere'"));
  CHECK(contains(several, "no plain text"));
  const std::string blocks = faults(window_text("Columns", two_rings, {{.data = "1 2"}, {.direction = "Reflection Front", .data = "1 x"}}));
  CHECK(contains(blocks, "2 values in Reflection Back"));
  CHECK(contains(blocks, "'x' at byte"));
}

TEST_CASE("A file of a million tiny elements is refused before it is parsed") {
  std::string text = "<WindowElement>";
  for (int k = 0; k < 200000; ++k) text += "<a/>";
  CHECK(contains(faults(text), "200001 tags|at most"));
}

TEST_CASE("No damaged file does more than raise an error") {
  const std::string basis = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";
  const std::vector<std::string> originals{
      window_text("Columns", two_rings, {{.data = counting()}, {.direction = "Transmission Front", .data = counting(0.5)}}),
      window_text("TensorTree3", "",
                  {{.data = "{ {1} {0} {2 3 4 5 6 7 8 9} {0} {3} {0} {4} {0} }", .basis = basis},
                   {.wavelength = "CIE-u", .data = "{0.2}", .basis = basis},
                   {.wavelength = "CIE-v", .data = "{0.4}", .basis = basis}}),
      window_text("TensorTree4", "", {{.data = "{ 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 }", .basis = basis}})};
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.format = "radiance-xml";
  const auto [accepted, refused] =
      test::read_damaged(originals, "0123456789.,-+e{}<>/&;\" \nnaif", 20260801, 6000, [&](const std::string& bytes) {
        const Opened file = open_brdf(folder.file("m.xml", bytes), options);
        for (const double value : file.brdf->eval(down_x, up_y)) REQUIRE_FALSE(std::isinf(value));
      });
  CHECK(accepted > 100);
  CHECK(refused > 2000);
}

TEST_CASE("Truncated anywhere a file is refused") {
  const std::string text = window_text("Columns", two_rings, {{.data = counting()}});
  const test::TemporaryFolder folder;
  ReadOptions options;
  options.format = "radiance-xml";
  // Nothing but blanks may be missing at the end.
  for (std::size_t size = 0; size + 2 < text.size(); size += 3) {
    const auto path = folder.file("m.xml", text.substr(0, size));
    INFO(size << " bytes");
    CHECK_FALSE(test::faults_of([&] { open_brdf(path, options); }).empty());
  }
}

TEST_CASE("The woven shade: 145 x 145, hemispherical as its sums, reciprocal as well as it was measured") {
  const auto path = test::measured_data("klems/klems_aniso_high.xml");
  if (!path) return;
  const Opened file = open_brdf(*path);
  const auto table = std::dynamic_pointer_cast<const KlemsTable>(file.brdf);
  REQUIRE(table);
  CHECK(table->incident().size() == 145);
  CHECK(table->outgoing().size() == 145);
  CHECK(said(file, "missing blocks") == "none");
  // Facts of the file: its first numbers, and what Radiance's own check prints of it (interior 41.6 %, exterior 66.0 %, through 1.8 %).
  CHECK(table->value(0, 0, 0) == 7.867e-02);
  CHECK(table->value(0, 1, 0) == 7.835e-02);
  const auto largest = [&](const std::map<std::string, std::string>& assume) {
    ReadOptions options;
    options.assume = assume;
    const auto block = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(*path, options).brdf);
    double out = 0;
    for (std::size_t in = 0; in < 145; ++in) out = std::max(out, block->hemispherical(0, in));
    return out;
  };
  CHECK(largest({}) == Approx(0.416).margin(5e-4));
  CHECK(largest({{"side", "front"}}) == Approx(0.660).margin(5e-4));
  // The hemispherical value is what integrating the table gives.
  double sum = 0;
  constexpr int n = 300;
  for (int u = 0; u < n; ++u)
    for (int v = 0; v < 2 * n; ++v) {
      const double sine2 = (u + 0.5) / n, phi = (v + 0.5) * std::numbers::pi / n, sine = std::sqrt(sine2);
      sum += table->eval(Direction(), Direction::trusted(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine2)))[0];
    }
  CHECK(sum * std::numbers::pi / (2 * n * n) == Approx(table->hemispherical(0, 0)).epsilon(2e-3));
  // Mean |f(i,o) - f(o,i)| over the mean: 7 % as Radiance's check prints it.
  double differences = 0, count = 0;
  for (std::size_t in = 0; in < 145; ++in)
    for (std::size_t out = 0; out < in; ++out) {
      const double forward = table->value(0, in, out);
      const double reversed = table->value(0, *table->incident().opposite(out), *table->outgoing().opposite(in));
      differences += std::fabs(forward - reversed) / (0.5 * (forward + reversed));
      count += 1;
    }
  CHECK(differences / count == Approx(0.07).margin(0.03));
  // Anisotropic: turned by 90° about the normal the values change.
  double turned = 0;
  for (int phi = 0; phi < 360; phi += 45) {
    const auto at = [&](int turn) {
      return table->eval(Direction::spherical(60_deg, degrees(turn)), Direction::spherical(60_deg, degrees(phi + turn)))[0];
    };
    turned = std::max(turned, std::fabs(at(90) / at(0) - 1));
  }
  CHECK(turned > 0.05);
}

TEST_CASE("The isotropic shade and its excerpt agree where both know") {
  const auto whole = test::measured_data("klems/2011-SA1.xml"), small = test::measured_data("klems/2011-SA1-Small-CommaSeparated.XML");
  if (!whole || !small) return;
  ReadOptions through;
  through.assume = {{"kind", "transmission"}, {"side", "front"}};
  const Opened all = open_brdf(*whole, through), part = open_brdf(*small, through);
  CHECK(all.side == Side::transmission);
  CHECK(all.brdf->eval(Direction(), Direction::spherical(180_deg, 0_deg))[0] == 2.063833);
  CHECK(part.brdf->eval(Direction(), Direction::spherical(180_deg, 0_deg))[0] == 2.063833);
  CHECK(part.observations->block(0).size == 4);
  CHECK(part.masked.missing == 145 * 145 - 4);
  CHECK(open_brdf(*small).side == Side::transmission);
  // Both sides' reflection as Radiance's check prints it: interior 71.0 %, exterior 64.1 %.
  const auto largest = [&](const char* side) {
    ReadOptions options;
    options.assume = {{"side", side}};
    const auto table = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(*whole, options).brdf);
    double out = 0;
    for (std::size_t in = 0; in < 145; ++in) out = std::max(out, table->hemispherical(0, in));
    return out;
  };
  CHECK(largest("back") == Approx(0.710).margin(5e-4));
  CHECK(largest("front") == Approx(0.641).margin(5e-4));
  ReadOptions solar;
  solar.assume = {{"wavelength", "Solar"}};
  CHECK(contains(said(open_brdf(*whole, solar), "block"), "Reflection Back of Solar"));
}
