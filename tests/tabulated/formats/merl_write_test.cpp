// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/opened_samples.hpp"
#include "tests/random_directions.hpp"
#include "tests/shared_data.hpp"
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

WriteOptions means() {
  WriteOptions options;
  options.merl_values = MerlValues::cell_mean;
  return options;
}

/// A BRDF as if it had been read.
Opened source(std::shared_ptr<const Brdf> brdf, bool simulated = false) {
  Opened opened;
  opened.format = "test";
  opened.brdf = std::move(brdf);
  opened.simulated = simulated;
  return opened;
}

template <class Model>
Opened source(Model model, bool simulated = false) {
  return source(std::shared_ptr<const Brdf>(std::make_shared<const Model>(std::move(model))), simulated);
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

AnalyticBrdf ggx(double alpha) { return AnalyticBrdf("ggx", single_channel("value"), {{0.0, 0.9, 0.9, alpha}}); }

/// Mean relative error against `model` over pairs to 80°, of the channel r.
template <class Reader>
double mean_error(Reader&& reader, const Brdf& model) {
  test::Random random(test::seed);
  double sum = 0, count = 0;
  while (count < 40000) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.17365 || wo.z() < 0.17365) continue;
    sum += std::fabs(reader(wi, wo) / model.eval(wi, wo)[0] - 1);
    ++count;
  }
  return sum / count;
}

/// What a reader gets that takes the cell a pair lies in.
auto nearest_reader(const std::string& bytes) {
  return [&bytes](const Direction& wi, const Direction& wo) {
    return stored(bytes, 0, MerlGrid::index(MerlGrid::cell_of(half_difference(wi, wo)))) / 1500;
  };
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
  const ExportNotes notes = write_merl(source(blinn_phong(), true), scratch / "m.binary", on(MerlNodes::left));
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
  CHECK(below == notes.n_below_horizon);
  CHECK(notes.n_unknown + notes.n_negative == 0);
  CHECK(notes.n_nodes == MerlGrid::cell_count - below);
}

TEST_CASE("Any number of threads writes the same bytes") {
  const TemporaryFolder scratch;
  write_merl(source(blinn_phong()), scratch / "one", on(MerlNodes::centre, 1));
  write_merl(source(blinn_phong()), scratch / "three", on(MerlNodes::centre, 3));
  CHECK(read_file(scratch / "one") == read_file(scratch / "three"));
}

TEST_CASE("Written and read with the same node rule the model comes back; with the other rule it does not") {
  // Blinn-Phong is smooth in theta_h; the error is that of linear interpolation between 90 rows.
  constexpr double interpolation = 0.005, other_rule = 0.05;
  const AnalyticBrdf model = blinn_phong();
  const TemporaryFolder scratch;
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const MerlNodes other = nodes == MerlNodes::left ? MerlNodes::centre : MerlNodes::left;
    write_merl(source(model), scratch / "m.binary", on(nodes));
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
    write_merl(source(blinn_phong()), scratch / "a", on(nodes));
    const Opened read = open_merl(scratch / "a", {});
    write_merl(read, scratch / "b", on(nodes));
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
  write_merl(source(blinn_phong(), true), scratch / "m.binary", on(MerlNodes::centre));
  const Json sidecar = parse_json(read_file(scratch / "m.binary.json"), "sidecar");
  CHECK(sidecar.at("node_rule").string() == "centre");
  CHECK(sidecar.at("unit").string() == "1/sr");
  CHECK(sidecar.at("source").string() == "test");
  CHECK(sidecar.at("primaries").is_null());
  CHECK(sidecar.at("scale").at("g").number() == 1.15 / 1500);
  CHECK(sidecar.at("context").at("simulated").boolean());
  CHECK(open_merl(scratch / "m.binary", {}).simulated);
}

TEST_CASE("One channel fills all three planes; any other number than one or three is refused") {
  const TemporaryFolder scratch;
  write_merl(source(AnalyticBrdf("lambert", single_channel("value"), {{0.5}})), scratch / "m", on(MerlNodes::left));
  const Opened read = open_merl(scratch / "m", {});
  const std::vector<double> f = read.brdf->eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(40_deg, 100_deg));
  for (const double value : f) CHECK(value == Approx(0.5 / 3.14159265358979312).epsilon(1e-15));

  Channels two = rgb_channels();
  two.pop_back();
  CHECK(faults_of([&] {
          write_merl(source(AnalyticBrdf("lambert", two, {{0.5}, {0.5}})), scratch / "no", on(MerlNodes::left));
        }).find("2 channels") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "no"));
}

TEST_CASE("What the format cannot hold is masked and counted, never stored as a number") {
  const TemporaryFolder scratch;
  const ExportNotes unknown = write_merl(source(Awkward(std::numeric_limits<double>::quiet_NaN())), scratch / "m", on(MerlNodes::left));
  CHECK(unknown.n_unknown > 1000);
  CHECK(std::isnan(open_merl(scratch / "m", {}).brdf->eval(Direction(), Direction())[0]));
  CHECK(open_merl(scratch / "m", {}).masked.missing == unknown.n_unknown + unknown.n_below_horizon);
  CHECK(write_merl(source(Awkward(-0.1)), scratch / "m", on(MerlNodes::left)).n_negative == unknown.n_unknown);
}

TEST_CASE("A failure leaves neither the file nor its sidecar, and an old pair as it was") {
  const TemporaryFolder scratch;
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(faults_of([&] { write_merl(source(Awkward(infinity)), scratch / "m", on(MerlNodes::left)); }).find("infinite") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "m"));
  CHECK_FALSE(std::filesystem::exists(scratch / "m.json"));

  std::filesystem::create_directory(scratch / "folder");
  scratch.file("folder.json", "old");
  CHECK_FALSE(faults_of([&] { write_merl(source(blinn_phong()), scratch / "folder", on(MerlNodes::left)); }).empty());
  CHECK(read_file(scratch / "folder.json") == "old");
}

TEST_CASE("Read back on agreed nodes the mean error of GGX is below 0.2 %, and nothing is lost at the nodes") {
  const TemporaryFolder scratch;
  for (const double alpha : {0.1, 0.2, 0.3})
    for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
      const AnalyticBrdf model = ggx(alpha);
      write_merl(source(model), scratch / "m.binary", on(nodes));
      const Opened read = open_merl(scratch / "m.binary", {});
      const double error = mean_error([&](const Direction& wi, const Direction& wo) { return read.brdf->eval(wi, wo)[0]; }, model);
      INFO("alpha " << alpha << ", " << name(nodes) << ": " << error);
      CHECK(error < 0.002);
      double worst = 0;
      for (std::size_t cell = 0; cell < MerlGrid::cell_count; cell += 97) {
        const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(cell), nodes));
        if (pair.wi.z() < 1e-3 || pair.wo.z() < 1e-3) continue;
        worst = std::max(worst, std::fabs(read.brdf->eval(pair.wi, pair.wo)[0] / model.eval(pair.wi, pair.wo)[0] - 1));
      }
      CHECK(worst < 1e-13);  // f / scale x scale, and positions within a millionth of a cell are the node
    }
}

TEST_CASE("Means over cells serve a reader that takes the nearest cell, and the sidecar says so") {
  const TemporaryFolder scratch;
  const AnalyticBrdf model = ggx(0.1);
  write_merl(source(model), scratch / "left", on(MerlNodes::left));
  write_merl(source(model), scratch / "mean", means());
  const std::string left = read_file(scratch / "left"), mean = read_file(scratch / "mean");
  const double error_left = mean_error(nearest_reader(left), model), error_mean = mean_error(nearest_reader(mean), model);
  INFO(error_left << " left edge, " << error_mean << " cell mean");
  CHECK(error_left > 0.04);
  CHECK(error_mean < 0.03);
  const Json sidecar = parse_json(read_file(scratch / "mean.json"), "sidecar");
  CHECK(sidecar.at("values").string() == "cell_mean");
  CHECK(sidecar.at("node_rule").string() == "centre");

  // Two Gauss points an axis against 8 x 8 x 8 midpoints in cells across the lobe.
  double worst = 0;
  for (const MerlCell cell : {MerlCell{0, 10, 90}, MerlCell{12, 0, 0}, MerlCell{20, 45, 170}, MerlCell{30, 30, 7}, MerlCell{50, 20, 100}}) {
    double sum = 0, weights = 0;
    for (int h = 0; h < 8; ++h)
      for (int d = 0; d < 8; ++d)
        for (int p = 0; p < 8; ++p) {
          const double root = (static_cast<double>(cell.theta_h) + (h + 0.5) / 8) / 90;
          const HalfDifference at{degrees(90 * root * root), 0_deg, degrees(static_cast<double>(cell.theta_d) + (d + 0.5) / 8),
                                  degrees(static_cast<double>(cell.phi_d) + (p + 0.5) / 8)};
          const double weight = root * at.theta_h.sin() * at.theta_d.sin() * at.theta_d.cos();
          const DirectionPair pair = directions(at);
          sum += weight * model.eval(pair.wi, pair.wo)[0], weights += weight;
        }
    worst = std::max(worst, std::fabs(stored(mean, 0, MerlGrid::index(cell)) / 1500 / (sum / weights) - 1));
  }
  CHECK(worst < 2e-3);  // of the midpoints too
}

TEST_CASE("Samples become a table where they lie, and what is far from them is masked") {
  const TemporaryFolder scratch;
  const auto samples = std::make_shared<Dataset>();
  samples->channels = single_channel("value");
  samples->symmetry.isotropic = true;
  samples->f.resize(1);
  for (int theta_i = 0; theta_i <= 60; theta_i += 10)
    for (int theta_o = 0; theta_o <= 60; theta_o += 10)
      for (int phi = 0; phi < 360; phi += 15) {
        samples->angles.push_back({degrees(theta_i), 0_deg, degrees(theta_o), degrees(phi)});
        samples->f[0].push_back(0.25);
      }
  const ExportNotes notes = write_merl(opened_samples("csv", samples), scratch / "m", on(MerlNodes::left));
  CHECK(notes.n_unknown > 100000);
  const Opened read = open_merl(scratch / "m", {});
  CHECK(read.brdf->eval(Direction::spherical(33_deg, 0_deg), Direction::spherical(42_deg, 77_deg))[2] == Approx(0.25).epsilon(1e-12));
  CHECK(std::isnan(read.brdf->eval(Direction::spherical(85_deg, 0_deg), Direction::spherical(85_deg, 77_deg))[0]));
  bool said = false;
  for (const std::string& sentence : notes.lost) said |= sentence.find("reciprocal") != std::string::npos;
  CHECK(said);
}

TEST_CASE("A file of the RGL database becomes a MERL file that agrees with it at the nodes") {
  const auto file = test::measured_data("rgl/cc_ibiza_sunset_rgb.bsdf");
  if (!file) return;
  const TemporaryFolder scratch;
  const Opened material = open_brdf(*file);
  write_merl(material, scratch / "m", on(MerlNodes::centre));
  const Opened read = open_merl(scratch / "m", {});
  std::size_t compared = 0, wrong = 0;
  for (std::size_t cell = 0; cell < MerlGrid::cell_count; cell += 1009) {
    const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(cell), MerlNodes::centre));
    if (!above_horizon(pair)) continue;
    const std::vector<double> wanted = material.brdf->eval(pair.wi, pair.wo), found = read.brdf->eval(pair.wi, pair.wo);
    if (std::any_of(wanted.begin(), wanted.end(), [](double value) { return !(value >= 0); })) continue;
    for (std::size_t c = 0; c < 3; ++c) wrong += std::fabs(found[c] - wanted[c]) > 1e-9 * wanted[c] + 1e-12;
    ++compared;
  }
  CHECK(compared > 500);
  CHECK(wrong == 0);
}
