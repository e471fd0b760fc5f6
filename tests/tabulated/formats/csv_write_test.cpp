// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tabulated/formats/csv.hpp"
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

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same_bits(x, y); });
}
bool same_bits(const Angle& a, const Angle& b) {
  return same_bits(a.radians(), b.radians()) && same_bits(a.degrees(), b.degrees()) && same_bits(a.cos(), b.cos()) &&
         same_bits(a.sin(), b.sin()) && a.made_from_degrees() == b.made_from_degrees();
}

Dataset rich_dataset(bool angles_in_radians) {
  std::mt19937_64 random(20260702);
  std::uniform_real_distribution<double> uniform(0, 1);
  Dataset out;
  out.channels = rgb_channels();
  out.channels[1].wavelength_in_nm = 532.1;
  out.channels[2].polarisation_out.emplace("p: \\ parallel");
  out.symmetry = {true, false, true};
  out.side = Side::transmission;
  out.apertures = {0.1, std::nullopt, 0, 1.0 / 3};
  out.f.resize(3), out.u.resize(3);
  for (int k = 0; k < 500; ++k) {
    const auto angle = [&](double range) {
      return angles_in_radians ? radians(uniform(random) * range / 60) : degrees(uniform(random) * range);
    };
    out.angles.push_back({angle(90), angle(360), angle(180), angle(360)});
    for (std::size_t c = 0; c < 3; ++c) {
      out.f[c].push_back(k % 7 == 0 && c == 1 ? unknown : std::exp(40 * uniform(random) - 20) * (k % 5 == 0 ? -1 : 1));
      out.u[c].push_back(k % 3 == 0 ? unknown : uniform(random) + 1e-300);
    }
    out.extra["repeat"].push_back(k);
    out.extra["bench temperature, degC"].push_back(k % 2 ? unknown : 20 + uniform(random));
  }
  out.correlated = {{"scale", 0.005, {}}, {"tilt", 1e-3, std::vector<double>(500, 1.0 / 7)}};
  out.masked = {1, 2, 3, 4};
  out.provenance = {{"run", "a\nb\\n # c"}, {"key: with colon", " spaces "}, {"empty", ""}};
  out.simulated = true;
  return out;
}

}  // namespace

TEST_CASE("CSV to CSV loses nothing") {
  for (const bool angles_in_radians : {false, true}) {
    const Dataset out = rich_dataset(angles_in_radians);
    const TemporaryFolder scratch;
    write_csv(out, scratch / "a.csv");
    const Dataset in = read_csv(scratch / "a.csv");
    REQUIRE(in.size() == out.size());
    CHECK(in.channels == out.channels);
    CHECK(in.symmetry == out.symmetry);
    CHECK(in.side == out.side);
    CHECK(in.apertures.source_half_angle_deg == out.apertures.source_half_angle_deg);
    CHECK(in.apertures.receiver_half_angle_deg == out.apertures.receiver_half_angle_deg);
    CHECK(in.apertures.spot_diameter_m == out.apertures.spot_diameter_m);
    CHECK(in.apertures.field_diameter_m == out.apertures.field_diameter_m);
    CHECK(in.provenance == out.provenance);
    CHECK(in.simulated);
    CHECK(in.masked.nan == 1);
    CHECK(in.masked.missing == 2);
    CHECK(in.masked.below_horizon == 3);
    CHECK(in.masked.blocked == 4);
    bool same = true;
    for (std::size_t k = 0; k < out.size(); ++k)
      same = same && same_bits(in.angles[k].theta_i, out.angles[k].theta_i) && same_bits(in.angles[k].phi_i, out.angles[k].phi_i) &&
             same_bits(in.angles[k].theta_o, out.angles[k].theta_o) && same_bits(in.angles[k].phi_o, out.angles[k].phi_o);
    CHECK(same);
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(same_bits(in.f[c], out.f[c]));
      CHECK(same_bits(in.u[c], out.u[c]));
    }
    REQUIRE(in.extra.size() == out.extra.size());
    for (const auto& [name, values] : out.extra) CHECK(same_bits(in.extra.at(name), values));
    REQUIRE(in.correlated.size() == 2);
    CHECK(in.correlated[0].name == "scale");
    CHECK(in.correlated[0].u == 0.005);
    CHECK(in.correlated[0].sensitivity.empty());
    CHECK(in.correlated[1].name == "tilt");
    CHECK(same_bits(in.correlated[1].sensitivity, out.correlated[1].sensitivity));

    write_csv(in, scratch / "b.csv");
    CHECK(read_file(scratch / "a.csv") == read_file(scratch / "b.csv"));
  }
}

TEST_CASE("A data set whose columns would be mistaken for others is not written") {
  const TemporaryFolder scratch;
  for (const std::string name : {"theta_i_deg", "u_r", "repeat", "", "two\nlines"}) {
    Dataset data;
    data.channels = single_channel(name);
    data.angles = {{10_deg, 0_deg, 20_deg, 180_deg}};
    data.f = {{1.0}};
    CHECK(faults_of([&] { write_csv(data, scratch / "x.csv"); }).find("input|") == 0);
    CHECK_FALSE(std::filesystem::exists(scratch / "x.csv"));
  }
}

TEST_CASE("A file that cannot be written is an error that names it") {
  Dataset data;
  data.channels = single_channel("value");
  data.angles = {{10_deg, 0_deg, 20_deg, 180_deg}};
  data.f = {{1.0}};
  const TemporaryFolder scratch;
  CHECK(faults_of([&] { write_csv(data, scratch / "no/such/folder/x.csv"); }).find("x.csv") != std::string::npos);
}

TEST_CASE("A file of ours is f already and is not converted twice") {
  const TemporaryFolder scratch;
  write_csv(rich_dataset(false), scratch / "a.csv");
  ReadOptions options;
  options.quantity = Quantity::f_cos;
  CHECK(faults_of([&] { read_csv(scratch / "a.csv", options); }).find("says it holds f") != std::string::npos);
  options.quantity = Quantity::f;
  CHECK(read_csv(scratch / "a.csv", options).size() == 500);
}
