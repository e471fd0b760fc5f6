// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tabulated/formats/rgl_build.hpp"
#include "tabulated/formats/rgl_error.hpp"
#include "tabulated/formats/tensor_file.hpp"
#include "tabulated/mapped_file.hpp"
#include "tests/random_directions.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/ggx_anisotropic.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double pi = std::numbers::pi;
/// Values, densities and angles of the file are floats.
constexpr double node_tolerance = 1e-5;

Opened source_of(std::shared_ptr<const Brdf> brdf) {
  Opened out;
  out.format = "model";
  out.brdf = std::move(brdf);
  return out;
}

Opened model(const char* name, std::vector<double> values) {
  return source_of(std::make_shared<AnalyticBrdf>(name, single_channel("value"), std::vector<std::vector<double>>{std::move(values)}));
}

Opened ggx(double alpha) { return model("ggx", {0, 0.9, 1, alpha}); }

/// Any function of a pair as a BRDF.
class Function final : public Brdf {
 public:
  using Value = std::function<double(const Direction&, const Direction&, std::size_t)>;
  Function(Symmetry symmetry, Value value, Channels channels = single_channel("value"))
      : symmetry_(symmetry), value_(std::move(value)), channels_(std::move(channels)) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return symmetry_; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < f.size(); ++k) f[k] = value_(wi[k / channels_.size()], wo[k / channels_.size()], k % channels_.size());
  }

 private:
  Symmetry symmetry_;
  Value value_;
  Channels channels_;
};

constexpr Symmetry isotropic{.isotropic = true, .bilateral = true, .reciprocal = true};

WriteOptions of_size(GridSize size) {
  WriteOptions out;
  out.size = size;
  return out;
}

struct Written {
  ExportNotes notes;
  Opened opened;
};

Written written(const Opened& source, const WriteOptions& options = of_size(GridSize::paper), const char* format = "rgl") {
  const test::TemporaryFolder folder;
  Written out;
  const auto& write =
      std::find_if(formats().begin(), formats().end(), [&](const Format& f) { return std::string(f.name) == format; })->write;
  out.notes = write(source, folder / "m.bsdf", options);
  out.opened = open_brdf(folder / "m.bsdf");
  return out;
}

const RglTable& table_of(const Opened& opened) { return dynamic_cast<const RglTable&>(*opened.brdf); }

bool says(const std::vector<std::string>& sentences, const char* word) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& s) { return s.find(word) != std::string::npos; });
}

std::string fact(const ExportNotes& notes, const std::string& key) {
  for (const auto& [k, words] : notes.facts)
    if (k == key) return words;
  return "";
}

/// Largest relative difference at the file's nodes above the horizon, but for the half vector at the normal, whose azimuth is the table's.
double worst_node(const Opened& opened, const Function::Value& wanted) {
  const Dataset nodes = table_of(opened).samples();
  double worst = 0;
  REQUIRE(nodes.size() > 1000);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t c = 0; c < nodes.f.size(); ++c) {
      const double f = wanted(nodes.angles[k].wi(), nodes.angles[k].wo(), c);
      if (f > 0) worst = std::max(worst, std::fabs(nodes.f[c][k] / f - 1));
    }
  return worst;
}

}  // namespace

TEST_CASE("A written file has the version, the fields and the alignment that readers insist on") {
  const test::TemporaryFolder folder;
  for (const bool spectral : {false, true}) {
    (spectral ? write_rgl_spectral : write_rgl_rgb)(ggx(0.2), folder / "m.bsdf", of_size(GridSize::paper));
    const std::string bytes = test::read_file(folder / "m.bsdf");
    CHECK(bytes.substr(12, 2) == std::string("\1\0", 2));
    FaultList faults("m.bsdf");
    const auto tensors = read_tensors(std::as_bytes(std::span(bytes)), faults);
    REQUIRE(faults.empty());
    std::string names;
    for (const Tensor& tensor : tensors) {
      names += tensor.name + " ";
      CHECK((tensor.bytes.data() - reinterpret_cast<const std::byte*>(bytes.data())) % 8 == 0);
    }
    CHECK(names == (spectral ? "description phi_i theta_i sigma ndf vndf luminance wavelengths spectra jacobian "
                             : "description phi_i theta_i sigma ndf vndf luminance rgb jacobian "));
    CHECK(tensors.back().bytes.front() == std::byte{1});
    CHECK(tensors[1].floats() == std::vector<float>{0});
    CHECK(tensors[2].shape == std::vector<std::size_t>{8});
    CHECK(tensors[2].floats().back() == static_cast<float>(pi / 2));
  }
}

TEST_CASE("Nodes of a file hold the value of the source to 1e-5, isotropic or not") {
  for (const Opened& source : {ggx(0.1), ggx(0.4), model("lambert", {0.5}), source_of(std::make_shared<test::GgxAnisotropic>(0.15, 0.4))}) {
    const Written file = written(source);
    CHECK(file.opened.brdf->symmetry().isotropic == source.brdf->symmetry().isotropic);
    CHECK(worst_node(file.opened, [&](const Direction& wi, const Direction& wo, std::size_t) { return source.brdf->eval(wi, wo)[0]; }) <
          node_tolerance);
    CHECK(file.notes.n_unknown + file.notes.n_negative == 0);
    CHECK(file.notes.n_below_horizon > file.notes.n_nodes / 100);
  }
}

TEST_CASE("A file of the standard size is read back with a mean error below 0.2 %, the small one below 1.5 %") {
  for (const Opened& source : {ggx(0.1), ggx(0.3), model("lambert", {0.5}), model("ggx", {0.4, 0.04, 1, 0.3})}) {
    const ChannelMap map = map_to_rgb(source.brdf->channels());
    CHECK(mean_relative_error(*source.brdf, map, *written(source, of_size(GridSize::standard)).opened.brdf, 2) < 2e-3);
    CHECK(mean_relative_error(*source.brdf, map, *written(source).opened.brdf, 2) < 1.5e-2);
  }
}

TEST_CASE("The directional albedo of a file is that of its source to 0.1 %") {
  const Opened source = model("ggx", {0.3, 0.5, 1, 0.15});
  const auto& analytic = dynamic_cast<const AnalyticBrdf&>(*source.brdf);
  const Opened file = written(source, of_size(GridSize::standard)).opened;
  for (const double theta : {0.0, 30.0, 60.0, 75.0}) {
    constexpr std::size_t n = 400;
    const Direction wi = Direction::spherical(degrees(theta), 20_deg);
    double sum = 0;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const double sin2 = (double(a) + 0.5) / n, r = std::sqrt(sin2), phi = 2 * pi * (double(b) + 0.5) / n;
        sum += file.brdf->eval(wi, Direction::trusted(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2)))[1] * pi / (n * n);
      }
    INFO(theta);
    CHECK(std::fabs(sum / analytic.directional_albedo(degrees(theta))[0] - 1) < 1e-3);
  }
}

TEST_CASE("Real material files are written again as they are, and their spectra look the same") {
  SUCCEED();
  for (const char* name : {"aurora_white", "cc_ibiza_sunset", "vch_silk_blue"}) {
    const auto path = test::measured_data(std::string("rgl/") + name + "_rgb.bsdf");
    if (!path) continue;
    const Opened source = open_brdf(*path);
    const RglArrays before = read_rgl(*path);
    const RglArrays after = table_of(written(source, {}).opened).arrays();
    CHECK(after.values == before.values);
    CHECK(after.vndf == before.vndf);
    CHECK(after.ndf == before.ndf);
    CHECK(after.sigma == before.sigma);
    CHECK(after.luminance == before.luminance);
    CHECK(after.theta_i == before.theta_i);
    CHECK(after.description == before.description);

    const Opened spectral = written(source, {}, "rgl-spectral").opened;
    CHECK(spectral.brdf->channels().size() == 48);
    const RglArrays seen = table_of(written(spectral, {}).opened).arrays();
    float largest = 0, worst = 0;
    for (const float value : before.values) largest = std::max(largest, std::fabs(value));
    for (std::size_t k = 0; k < before.values.size(); ++k) worst = std::max(worst, std::fabs(seen.values[k] - before.values[k]));
    CHECK(worst < 1e-5f * largest);
  }
}

TEST_CASE("A real material on a grid built anew keeps the mean of both sides of the plane of incidence at the nodes") {
  const auto path = test::measured_data("rgl/cc_ibiza_sunset_rgb.bsdf");
  SUCCEED();
  if (!path) return;
  const Opened real = open_brdf(*path);
  const auto value = [&](const Direction& wi, const Direction& wo, std::size_t c) { return real.brdf->eval(wi, wo)[c]; };
  const Written file = written(
      source_of(std::make_shared<Function>(Symmetry{.isotropic = true, .bilateral = false, .reciprocal = false}, value, rgb_channels())));
  CHECK(says(file.notes.lost, "averaged"));
  const auto mirrored = [](const Direction& wi, const Direction& wo) {  // at the plane of incidence
    const double phi = 2 * wi.phi().radians() - wo.phi().radians();
    return Direction::spherical(wo.theta(), radians(phi));
  };
  CHECK(worst_node(file.opened, [&](const Direction& wi, const Direction& wo, std::size_t c) {
          const double here = value(wi, wo, c), there = value(wi, mirrored(wi, wo), c);
          return here > 0 && there > 0 ? (here + there) / 2 : 0;
        }) < 2 * node_tolerance);
}

TEST_CASE("One channel fills red, green and blue; spectra stay what they are; colours become spectra") {
  const Written rgb = written(ggx(0.3));
  const auto f = rgb.opened.brdf->eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(40_deg, 170_deg));
  CHECK(f[0] == f[1]);
  CHECK(f[0] == f[2]);
  CHECK(says(rgb.notes.lost, "copied"));

  Channels wavelengths;
  for (const double nm : {450.0, 550.0, 650.0}) {
    wavelengths.push_back(single_channel("s").front());
    wavelengths.back().wavelength_in_nm = wavelengths.back().wavelength_out_nm = nm;
  }
  const Opened spectral = source_of(std::make_shared<Function>(
      isotropic, [](const Direction&, const Direction&, std::size_t c) { return 0.1 * double(1 + c); }, wavelengths));
  const Written same = written(spectral, of_size(GridSize::paper), "rgl-spectral");
  CHECK(same.notes.lost.empty());
  const auto g = same.opened.brdf->eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(20_deg, 170_deg));
  REQUIRE(g.size() == 3);
  CHECK(std::fabs(g[2] / g[0] - 3) < node_tolerance);
  const Written seen = written(spectral);
  CHECK(says(seen.notes.lost, "D65"));
  const auto colour = seen.opened.brdf->eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(20_deg, 170_deg));
  CHECK(colour[0] > colour[2]);
}

TEST_CASE("A source that does not know its retro-reflection is written, and the notes say where the distribution is from") {
  const Opened known = ggx(0.15);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto shadow = [&](const Direction& wi, const Direction& wo, std::size_t) {
    return angle_between(wi, wo).degrees() < 8 ? nan : known.brdf->eval(wi, wo)[0];
  };
  const Written file = written(source_of(std::make_shared<Function>(isotropic, shadow)), of_size(GridSize::standard));
  CHECK(file.notes.n_unknown > 100);
  CHECK(says(file.notes.lost, "nothing is known"));
  CHECK(fact(file.notes, "retro-reflection").find("unknown at 128 of 128") != std::string::npos);
  // In the shadow too: the ratio to the microsurface hardly changes there.
  CHECK(mean_relative_error(*known.brdf, map_to_rgb(known.brdf->channels()), *file.opened.brdf, 2) < 5e-3);
  for (const double f : table_of(file.opened).arrays().values) REQUIRE(std::isfinite(f));

  const Opened nowhere = source_of(std::make_shared<Function>(isotropic, [&](auto&&...) { return nan; }));
  CHECK(test::faults_of([&] { written(nowhere); }).find("nothing known") != std::string::npos);
}

TEST_CASE("Negative values are written as 0 and counted; a black surface has a density to sample; infinity is refused") {
  const Written negative = written(source_of(
      std::make_shared<Function>(isotropic, [](const Direction& wi, const Direction& wo, std::size_t) { return dot(wi, wo) - 0.2; })));
  CHECK(negative.notes.n_negative > 10);
  CHECK(says(negative.notes.lost, "negative"));
  const RglArrays arrays = table_of(negative.opened).arrays();
  CHECK(*std::min_element(arrays.values.begin(), arrays.values.end()) == 0);

  const Written black = written(source_of(std::make_shared<Function>(isotropic, [](auto&&...) { return 0.0; })));
  const RglArrays dark = table_of(black.opened).arrays();
  CHECK(*std::min_element(dark.luminance.begin(), dark.luminance.end()) == 1);
  CHECK(black.opened.brdf->eval(Direction{}, Direction{})[0] == 0);

  const test::TemporaryFolder folder;
  const Opened infinite =
      source_of(std::make_shared<Function>(isotropic, [](auto&&...) { return std::numeric_limits<double>::infinity(); }));
  CHECK(test::faults_of([&] { write_rgl_rgb(infinite, folder / "m.bsdf", {}); }).find("infinite") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "m.bsdf"));
}

TEST_CASE("Transmission, samples that cannot be evaluated and channels of unknown meaning are refused") {
  const test::TemporaryFolder folder;
  Opened source = ggx(0.3);
  Dataset behind;
  behind.side = Side::transmission;
  source.dataset = std::make_shared<const Dataset>(behind);
  CHECK(test::faults_of([&] { write_rgl_rgb(source, folder / "m", {}); }).find("transmission") != std::string::npos);
  CHECK(test::faults_of([&] { write_rgl_rgb(Opened{}, folder / "m", {}); }).find("cannot be evaluated") != std::string::npos);
  Channels polarised = rgb_channels();
  polarised[0].name = "p";
  const Opened unknown = source_of(std::make_shared<Function>(
      isotropic, [](auto&&...) { return 1.0; }, polarised));
  CHECK(test::faults_of([&] { write_rgl_rgb(unknown, folder / "m", {}); }).find("p, g, b") != std::string::npos);
}

TEST_CASE("A wanted error chooses the smallest grid that keeps it and names the ones it tried") {
  const Opened source = ggx(0.2);
  WriteOptions options;
  options.error = 0.003;
  const Written file = written(source, options);
  const double error = mean_relative_error(*source.brdf, map_to_rgb(source.brdf->channels()), *file.opened.brdf, 2);
  CHECK(error <= 0.003);
  CHECK(fact(file.notes, "grid") == "16 x 48 x 48");
  CHECK(fact(file.notes, "errors by grid").find("8 x 32 x 32: ") == 0);
  CHECK(fact(file.notes, "errors by grid").find("32 x 64 x 64") == std::string::npos);
}

TEST_CASE("A written file that breaks off anywhere in its table of fields, or at the end of any field, is refused") {
  const test::TemporaryFolder folder;
  write_rgl_rgb(ggx(0.3), folder / "m.bsdf", of_size(GridSize::paper));
  const std::string bytes = test::read_file(folder / "m.bsdf");
  FaultList none("m.bsdf");
  std::vector<std::size_t> ends;
  for (const Tensor& tensor : read_tensors(std::as_bytes(std::span(bytes)), none))
    ends.push_back(static_cast<std::size_t>(tensor.bytes.data() - reinterpret_cast<const std::byte*>(bytes.data())));
  for (std::size_t k = tensor_file_signature.size(); k < ends.front(); ++k) ends.push_back(k);
  ends.push_back(bytes.size() - 1);
  ReadOptions options;
  options.format = "rgl";
  for (const std::size_t end : ends) {
    INFO("cut at byte " << end);
    CHECK(test::faults_of([&] { open_brdf(folder.file("cut.bsdf", bytes.substr(0, end)), options); }).starts_with("input|"));
  }
}
