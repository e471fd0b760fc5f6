// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/merl.hpp"
#include "tests/random_directions.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

AnalyticBrdf blinn_phong() { return AnalyticBrdf("blinn-phong", rgb_channels(), {{0.1, 0.3, 40}, {0.2, 0.2, 40}, {0.3, 0.1, 40}}); }

/// The stored number of a cell, straight from the bytes.
double stored(const std::string& bytes, std::size_t plane, std::size_t cell) {
  double value = 0;
  std::memcpy(&value, bytes.data() + 12 + 8 * (plane * MerlGrid::cell_count + cell), sizeof value);
  return value;
}

WriteOptions on(MerlNodes nodes, int threads = 2) {
  WriteOptions options;
  options.merl_nodes = nodes, options.threads = threads;
  return options;
}

ReadOptions as(MerlNodes nodes) {
  ReadOptions options;
  options.merl_nodes = nodes;
  return options;
}

/// Largest relative difference to the model over pairs up to 80°.
double worst_difference(const Brdf& table, const Brdf& model) {
  test::Random random(test::seed);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.17 || wo.z() < 0.17) continue;
    worst = std::max(worst, std::fabs(table.eval(wi, wo)[0] / model.eval(wi, wo)[0] - 1));
  }
  return worst;
}

/// Gives NaN, a negative number or an infinity in one corner of the hemisphere.
class Awkward final : public Brdf {
 public:
  explicit Awkward(double value) : value_(value), channels_(single_channel("value")) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) f[k] = wi[k].z() > 0.9 && wo[k].z() > 0.9 ? value_ : 0.5;
  }

 private:
  double value_;
  Channels channels_;
};

}  // namespace

TEST_CASE("The file has MERL's size, header, scales and masks") {
  const TemporaryFolder scratch;
  const MerlWriteResult result = write_merl(blinn_phong(), scratch / "m.binary", on(MerlNodes::left), "test", true);
  const std::string bytes = read_file(scratch / "m.binary");
  REQUIRE(bytes.size() == 34992012);
  CHECK(bytes.substr(0, 12) == std::string("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12));
  std::size_t wrong = 0, below = 0;
  const double scale[] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  const AnalyticBrdf model = blinn_phong();
  for (std::size_t k = 0; k < MerlGrid::cell_count; k += 11) {
    const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(k), MerlNodes::left));
    const std::vector<double> f = model.eval(pair.wi, pair.wo);
    for (std::size_t c = 0; c < 3; ++c) wrong += stored(bytes, c, k) != (above_horizon(pair) ? f[c] / scale[c] : -1.0);
  }
  for (std::size_t k = 0; k < MerlGrid::cell_count; ++k) below += stored(bytes, 0, k) == -1;
  CHECK(wrong == 0);
  CHECK(below == result.below_horizon);
  CHECK(result.unknown + result.negative == 0);
}

TEST_CASE("Any number of threads writes the same bytes") {
  const TemporaryFolder scratch;
  write_merl(blinn_phong(), scratch / "one", on(MerlNodes::centre, 1), "test", false);
  write_merl(blinn_phong(), scratch / "three", on(MerlNodes::centre, 3), "test", false);
  CHECK(read_file(scratch / "one") == read_file(scratch / "three"));
}

TEST_CASE("Written and read with the same node rule the model comes back; with the other rule it does not") {
  // Blinn-Phong is smooth in theta_h; the error is that of linear interpolation between 90 rows.
  constexpr double interpolation = 0.005, other_rule = 0.05;
  const AnalyticBrdf model = blinn_phong();
  const TemporaryFolder scratch;
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const MerlNodes other = nodes == MerlNodes::left ? MerlNodes::centre : MerlNodes::left;
    write_merl(model, scratch / "m.binary", on(nodes), "test", false);
    CHECK(worst_difference(*open_merl(scratch / "m.binary", as(nodes)).brdf, model) < interpolation);
    CHECK(worst_difference(*open_merl(scratch / "m.binary", as(other)).brdf, model) > other_rule);
    // Without an option the sidecar decides.
    CHECK(worst_difference(*open_merl(scratch / "m.binary", {}).brdf, model) < interpolation);
    // Without either it is the left edge.
    std::filesystem::remove(scratch / "m.binary.json");
    const double unsaid = worst_difference(*open_merl(scratch / "m.binary", {}).brdf, model);
    CHECK((nodes == MerlNodes::left ? unsaid < interpolation : unsaid > other_rule));
  }
}

TEST_CASE("A table written again from its own reading is the same file") {
  const TemporaryFolder scratch;
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    write_merl(blinn_phong(), scratch / "a", on(nodes), "test", false);
    const Opened read = open_merl(scratch / "a", {});
    write_merl(*read.brdf, scratch / "b", on(nodes), "test", false);
    const std::string a = read_file(scratch / "a"), b = read_file(scratch / "b");
    // f = stored x scale and back rounds twice.
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < MerlGrid::cell_count; ++k)
        worst = std::max(worst, std::fabs(stored(b, c, k) - stored(a, c, k)) / std::fabs(stored(a, c, k)));
    CHECK(worst < 1e-15);
  }
}

TEST_CASE("The sidecar says what the format cannot") {
  const TemporaryFolder scratch;
  write_merl(blinn_phong(), scratch / "m.binary", on(MerlNodes::centre), "a model", true);
  const Json sidecar = parse_json(read_file(scratch / "m.binary.json"), "sidecar");
  CHECK(sidecar.at("node_rule").string() == "centre");
  CHECK(sidecar.at("unit").string() == "1/sr");
  CHECK(sidecar.at("source").string() == "a model");
  CHECK(sidecar.at("primaries").is_null());
  CHECK(sidecar.at("scale").at("g").number() == 1.15 / 1500);
  CHECK(sidecar.at("context").at("simulated").boolean());
  CHECK(open_merl(scratch / "m.binary", {}).simulated);
}

TEST_CASE("One channel fills all three planes; any other number than one or three is refused") {
  const TemporaryFolder scratch;
  write_merl(AnalyticBrdf("lambert", single_channel("value"), {{0.5}}), scratch / "m", on(MerlNodes::left), "test", false);
  const Opened read = open_merl(scratch / "m", {});
  const std::vector<double> f = read.brdf->eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(40_deg, 100_deg));
  for (const double value : f) CHECK(value == Approx(0.5 / 3.14159265358979312).epsilon(1e-15));

  Channels two = rgb_channels();
  two.pop_back();
  CHECK(faults_of([&] {
          write_merl(AnalyticBrdf("lambert", two, {{0.5}, {0.5}}), scratch / "no", on(MerlNodes::left), "test", false);
        }).find("2 channels") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "no"));
}

TEST_CASE("What the format cannot hold is masked and counted, never stored as a number") {
  const TemporaryFolder scratch;
  const MerlWriteResult unknown =
      write_merl(Awkward(std::numeric_limits<double>::quiet_NaN()), scratch / "m", on(MerlNodes::left), "test", false);
  CHECK(unknown.unknown > 1000);
  CHECK(std::isnan(open_merl(scratch / "m", {}).brdf->eval(Direction(), Direction())[0]));
  CHECK(open_merl(scratch / "m", {}).masked.missing == unknown.unknown + unknown.below_horizon);
  CHECK(write_merl(Awkward(-0.1), scratch / "m", on(MerlNodes::left), "test", false).negative == unknown.unknown);
}

TEST_CASE("A failure leaves neither the file nor its sidecar, and an old pair as it was") {
  const TemporaryFolder scratch;
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(faults_of([&] { write_merl(Awkward(infinity), scratch / "m", on(MerlNodes::left), "test", false); }).find("infinite") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "m"));
  CHECK_FALSE(std::filesystem::exists(scratch / "m.json"));

  std::filesystem::create_directory(scratch / "folder");
  scratch.file("folder.json", "old");
  CHECK_FALSE(faults_of([&] { write_merl(blinn_phong(), scratch / "folder", on(MerlNodes::left), "test", false); }).empty());
  CHECK(read_file(scratch / "folder.json") == "old");
}
