// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/brdf_exr.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tabulated/formats/csv.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::read_file;
using gonio::test::TemporaryFolder;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double float_rounding = 6e-8;       // half a unit in the last place of a float
constexpr double angle_rounding_deg = 1e-12;  // two floats hold 48 bits

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

Channels spectral_channels() {
  Channels out;
  for (const char* name : {"450nm", "550 nm, p", "650nm"}) out.push_back(single_channel(name).front());
  return out;
}

/// A grid of 5 x 24 directions, some cells empty.
Dataset grid(Channels channels, bool float_data) {
  std::mt19937_64 random(20260705);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto value = [&](double x) { return float_data ? static_cast<double>(static_cast<float>(x)) : x; };
  Dataset out;
  out.channels = std::move(channels);
  out.f.resize(out.channels.size()), out.u.resize(out.channels.size());
  for (int i = 0; i < 5; ++i)
    for (int o = 0; o < 24; ++o) {
      if (uniform(random) < 0.2) continue;
      out.angles.push_back({degrees(15.1 * i), degrees(0.3 * i), degrees(3.7 * o), degrees(180.123456789)});
      for (std::size_t c = 0; c < out.channels.size(); ++c) {
        out.f[c].push_back(c == 1 && o == 3 ? unknown : value(std::exp(20 * uniform(random) - 15) * (o == 5 ? -1 : 1)));
        out.u[c].push_back(c == 1 && o == 3 ? unknown : o == 7 ? unknown : value(uniform(random) + 1e-6));
      }
    }
  out.symmetry = {true, true, false};
  out.apertures = {0.25, 0, std::nullopt, 0.02};
  out.correlated = {{"scale", 0.01, {}}, {"tilt", 0.001, std::vector<double>(out.size(), 0.5)}};
  out.masked = {1, 0, 5, 2};
  out.provenance = {{"sample", "Spectralon #3\nwhite"}, {"a.b: c", "\\"}};
  out.simulated = true;
  return out;
}

Dataset there_and_back(const Dataset& dataset) {
  const TemporaryFolder scratch;
  write_brdf_exr(tabulate(dataset), scratch / "t.brdf.exr");
  const Opened opened = open_brdf(scratch / "t.brdf.exr");
  REQUIRE(opened.format == "brdf-exr");
  return *opened.dataset;
}

}  // namespace

TEST_CASE("Float data come back with the same bits, doubles within a float's rounding") {
  Channels spectral = spectral_channels();
  spectral[1].wavelength_in_nm = 550;
  for (const Channels& channels : {rgb_channels(), single_channel("value"), spectral})
    for (const bool float_data : {true, false}) {
      const Dataset in = grid(channels, float_data), out = there_and_back(in);
      REQUIRE(out.size() == in.size());
      REQUIRE(out.channels == in.channels);
      bool same = true;
      for (std::size_t k = 0; k < in.size(); ++k) {
        same = same && std::fabs(out.angles[k].theta_i.degrees() - in.angles[k].theta_i.degrees()) < angle_rounding_deg &&
               std::fabs(out.angles[k].phi_i.degrees() - in.angles[k].phi_i.degrees()) < angle_rounding_deg &&
               std::fabs(out.angles[k].theta_o.degrees() - in.angles[k].theta_o.degrees()) < angle_rounding_deg &&
               std::fabs(out.angles[k].phi_o.degrees() - in.angles[k].phi_o.degrees()) < angle_rounding_deg;
        for (std::size_t c = 0; c < in.channels.size(); ++c) {
          const auto equal = [&](double a, double b) {
            return float_data ? same_bits(a, b) : std::isnan(a) ? std::isnan(b) : std::fabs(a / b - 1) <= float_rounding;
          };
          same = same && equal(in.f[c][k], out.f[c][k]) && equal(in.u[c][k], out.u[c][k]);
        }
      }
      CHECK(same);
    }
}

TEST_CASE("What a data set says about itself comes back") {
  const Dataset in = grid(rgb_channels(), true), out = there_and_back(in);
  CHECK(out.symmetry == in.symmetry);
  CHECK(out.apertures.source_half_angle_deg == 0.25);
  CHECK(out.apertures.receiver_half_angle_deg == 0.0);
  CHECK_FALSE(out.apertures.spot_diameter_m.has_value());
  REQUIRE(out.correlated.size() == 2);
  CHECK(out.correlated[0].sensitivity.empty());
  CHECK(out.correlated[1].u == 0.001);
  CHECK(out.correlated[1].sensitivity == in.correlated[1].sensitivity);
  CHECK(out.masked.below_horizon == 5);
  CHECK(out.provenance == in.provenance);
  CHECK(out.simulated);
}

TEST_CASE("How values came about comes back; a column of that name with other values has no place") {
  const TemporaryFolder folder;
  Dataset data = grid(rgb_channels(), true);
  for (std::size_t k = 0; k < data.size(); ++k) data.extra["coverage"].push_back(static_cast<double>(k % 3));
  const SampleTable table = tabulate(data);
  CHECK(table.dropped_columns.empty());
  write_brdf_exr(table, folder / "a.brdf.exr");
  CHECK(samples_of(read_brdf_exr(folder / "a.brdf.exr")).extra.at("coverage") == samples_of(table).extra.at("coverage"));

  SampleTable damaged = table;
  damaged.coverage.front() = 7;
  write_brdf_exr(damaged, folder / "b.brdf.exr");
  CHECK(faults_of([&] { read_brdf_exr(folder / "b.brdf.exr"); }).find("coverage") != std::string::npos);

  data.extra["coverage"].front() = 0.5;
  CHECK(tabulate(data).dropped_columns == std::vector<std::string>{"coverage"});
  CHECK(tabulate(data).coverage.empty());
}

TEST_CASE("Unknown uncertainty stays unknown") {
  Dataset in = grid(rgb_channels(), true);
  in.u.clear();
  CHECK_FALSE(there_and_back(in).has_uncertainty());
}

TEST_CASE("An uncertainty too small for a float does not become a claim of none") {
  Dataset in = grid(single_channel("value"), true);
  in.u[0][0] = 1e-60;
  CHECK(there_and_back(in).u[0][0] > 0);
}

TEST_CASE("A value too large for a float is refused and nothing is written") {
  const TemporaryFolder scratch;
  Dataset in = grid(single_channel("value"), true);
  in.f[0][0] = 1e39;
  CHECK(faults_of([&] { write_brdf_exr(tabulate(in), scratch / "t"); }).find("1e+39") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "t"));
}

TEST_CASE("A channel name that another one has, or that is empty, is refused") {
  const TemporaryFolder scratch;
  Dataset in = grid(rgb_channels(), true);
  in.channels[1] = in.channels[0];
  CHECK(faults_of([&] { write_brdf_exr(tabulate(in), scratch / "t"); }).find("part value|a channel named 'f.r'") != std::string::npos);
}

TEST_CASE("The measured RT-300S file is the same samples as a table") {
  const auto path = test::measured_data("loft_rt300s/raw_csv/NiTE_on_steel_v1o0A_20250915.csv");
  if (!path) return;
  ReadOptions options;
  options.columns = {{"phi_o_deg", "azimuth_deg"}, {"theta_i_deg", "incidence_deg"}, {"theta_o_deg", "receive_deg"}, {"value", "RT"}};
  options.set = {{"phi_i_deg", 90}};
  options.quantity = Quantity::signal_ratio;
  const Dataset in = read_csv(*path, options), out = there_and_back(in);
  // Azimuth -90 with receive r and azimuth 90 with receive -r are one direction, and so is receive 0 at every azimuth.
  double samples = 0;
  for (const double n : out.extra.at("n")) samples += n;
  CHECK(samples == static_cast<double>(in.size()));
  CHECK(out.size() == 4 * (33 + 17 * 32));
}

TEST_CASE("A truncated file is refused, wherever it is cut") {
  const TemporaryFolder scratch;
  write_brdf_exr(tabulate(grid(rgb_channels(), true)), scratch / "t");
  const std::string whole = read_file(scratch / "t");
  int refused = 0, cuts = 0;
  for (std::size_t size = 4; size < whole.size(); size += 37) {
    ++cuts;
    refused += !faults_of([&] { open_brdf(scratch.file("cut", std::string_view(whole).substr(0, size))); }).empty();
  }
  CHECK(cuts > 100);
  CHECK(refused == cuts);
}

TEST_CASE("Another kind of image or no image at all is refused") {
  const TemporaryFolder scratch;
  ReadOptions options;
  options.format = "brdf-exr";
  CHECK(faults_of([&] { open_brdf(scratch.file("text", "not an image"), options); }).find("input|") == 0);
  CHECK(faults_of([&] { open_brdf(scratch.file("magic", "\x76\x2f\x31\x01 and no more")); }).find("input|") == 0);
}

TEST_CASE("No damaged EXR file does more than raise an error") {
  const TemporaryFolder scratch;
  const Channels spectral = spectral_channels();
  write_brdf_exr(tabulate(grid(spectral, true)), scratch / "t");
  const std::string whole = read_file(scratch / "t");
  std::mt19937 random(20260706);
  const std::size_t header_end = whole.find("displayWindow") + 4000;  // most damage where it can do most harm
  int read = 0, refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = whole;
    for (std::size_t edit = 0, edits = 1 + random() % 3; edit < edits; ++edit) {
      const std::size_t range = random() % 4 == 0 ? bytes.size() : std::min(header_end, bytes.size());
      bytes[random() % range] = static_cast<char>(random() % 3 == 0 ? 0xff : random());
    }
    if (random() % 20 == 0) bytes.resize(random() % bytes.size());
    INFO("round " << round << " of seed 20260706");
    ReadOptions options;
    options.format = "brdf-exr";
    try {
      open_brdf(scratch.file("damaged", bytes), options).dataset->require_consistent();
      ++read;
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::input);
      ++refused;
    }
  }
  CHECK(read > 100);
  CHECK(refused > 100);
}
