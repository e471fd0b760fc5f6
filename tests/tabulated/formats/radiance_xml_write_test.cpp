// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/klems_table.hpp"
#include "tabulated/tensor_tree_table.hpp"
#include "tests/random_directions.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

template <class Model>
Opened source(Model model) {
  Opened opened;
  opened.format = "test";
  opened.brdf = std::make_shared<const Model>(std::move(model));
  return opened;
}

AnalyticBrdf ggx(double alpha) { return AnalyticBrdf("ggx", single_channel("value"), {{0.1, 0.5, 0.9, alpha}}); }
AnalyticBrdf ward() { return AnalyticBrdf("ward-anisotropic", single_channel("value"), {{0.1, 0.2, 0.15, 0.4}}); }

/// The same everywhere but for one quarter, where it is whatever is wanted.
class Odd final : public Brdf {
 public:
  explicit Odd(double value) : value_(value), channels_(single_channel("value")) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  void eval(std::span<const Direction> wi, std::span<const Direction>, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) f[k] = wi[k].x() > 0 && wi[k].y() > 0 ? value_ : 0.25;
  }

 private:
  double value_;
  Channels channels_;
};

Direction random_direction(test::Random& random) {  // uniform in projected solid angle
  const double r = std::sqrt(test::uniform(random, 0, 0.99)), phi = test::uniform(random, -std::numbers::pi, std::numbers::pi);
  return Direction::trusted(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r));
}

bool lost(const ExportNotes& notes, const std::string& words) {
  for (const std::string& sentence : notes.lost)
    if (sentence.find(words) != std::string::npos) return true;
  return false;
}

WriteOptions small() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

}  // namespace

TEST_CASE("A perfect white comes back as one over pi everywhere, on both sides, in every grid") {
  const test::TemporaryFolder folder;
  for (const auto write : {write_radiance_klems_half, write_radiance_klems_quarter, write_radiance_tree3, write_radiance_tree4}) {
    const ExportNotes notes = write(source(AnalyticBrdf("lambert", single_channel("value"), {{1.0}})), folder / "m.xml", small());
    CHECK_FALSE(lost(notes, "energy"));
    test::Random random(test::seed);
    for (const char* side : {"back", "front"}) {
      ReadOptions options;
      options.assume = {{"side", side}};
      const Opened read = open_brdf(folder / "m.xml", options);
      for (int k = 0; k < 200; ++k)
        CHECK(read.brdf->eval(random_direction(random), random_direction(random))[0] == Approx(std::numbers::inv_pi).epsilon(1e-6));
    }
  }
}

TEST_CASE("Values of a matrix are means over pairs of patches weighted by projected solid angle") {
  const test::TemporaryFolder folder;
  const AnalyticBrdf model = ward();
  write_radiance_klems_half(source(model), folder / "m.xml", small());
  const auto table = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(folder / "m.xml").brdf);
  REQUIRE(table);
  // Against random pairs of the patches, across the lobe and beside it.
  test::Random random(test::seed);
  const auto inside = [&](const KlemsBasis& basis, std::size_t index) {
    const KlemsBasis::Patch patch = basis.patch(index);
    const double low = degrees(patch.ring->lower_deg).sin(), high = degrees(patch.ring->upper_deg).sin();
    const double sine = std::sqrt(test::uniform(random, low * low, high * high));
    const Angle phi = degrees(patch.centre_phi_deg + patch.width_deg * test::uniform(random, -0.5, 0.5));
    return Direction::trusted(sine * phi.cos(), sine * phi.sin(), std::sqrt(1 - sine * sine));
  };
  const KlemsBasis& basis = table->incident();
  for (const auto& [theta_i, phi_i, theta_o, phi_o] :
       {std::array{0.0, 0.0, 10.0, 45.0}, {30.0, 18.0, 30.0, 198.0}, {60.0, 90.0, 50.0, 285.0}}) {
    const Direction light = Direction::spherical(degrees(theta_i), degrees(phi_i)),
                    view = Direction::spherical(degrees(theta_o), degrees(phi_o));
    const auto in = basis.patch_of(-light.x(), -light.y(), light.z()), out = basis.patch_of(view.x(), view.y(), view.z());
    double sum = 0, squares = 0;
    constexpr int n = 40000;
    for (int k = 0; k < n; ++k) {
      const Direction shadow = inside(basis, *in);
      const double f = model.eval(Direction::trusted(-shadow.x(), -shadow.y(), shadow.z()), inside(basis, *out))[0];
      sum += f, squares += f * f;
    }
    const double mean = sum / n, deviation = std::sqrt((squares / n - mean * mean) / n);
    INFO(theta_i << " " << phi_i << " -> " << theta_o << " " << phi_o << ": " << table->value(0, *in, *out) << " against " << mean);
    CHECK(std::fabs(table->value(0, *in, *out) - mean) < 4.5 * deviation + 1e-3 * mean);
  }
}

TEST_CASE("A reciprocal model is reciprocal in the matrix, and keeps its energy whatever the grid") {
  const test::TemporaryFolder folder;
  write_radiance_klems_quarter(source(ward()), folder / "m.xml", small());
  const auto table = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(folder / "m.xml").brdf);
  const KlemsBasis& basis = table->incident();
  double worst = 0;
  for (std::size_t in = 0; in < basis.size(); ++in)
    for (std::size_t out = 0; out < in; ++out)
      worst = std::max(worst, std::fabs(table->value(0, in, out) / table->value(0, *basis.opposite(out), *basis.opposite(in)) - 1));
  CHECK(worst < 1e-2);  // rules are settled to 1e-3 but for a few pairs at the horizon

  std::vector<double> totals;
  for (const auto write : {write_radiance_klems_half, write_radiance_klems_quarter, write_radiance_tree3, write_radiance_tree4}) {
    write(source(ggx(0.3)), folder / "m.xml", small());
    const Opened read = open_brdf(folder / "m.xml");
    // Mean over all incidences, by the cells of a fine grid in the square.
    test::Random random(test::seed);
    double sum = 0;
    constexpr int n = 100000;
    for (int k = 0; k < n; ++k) sum += read.brdf->eval(random_direction(random), random_direction(random))[0];
    totals.push_back(sum / n);
  }
  for (const double total : totals) CHECK(total == Approx(totals[0]).epsilon(0.02));
}

TEST_CASE("Trees give their cells' means, agree with the model better the finer they are, and keep a wanted error") {
  const test::TemporaryFolder folder;
  const AnalyticBrdf model = ggx(0.3);
  const auto error = [&](const Brdf& table) {
    test::Random random(test::seed);
    double sum = 0;
    for (int k = 0; k < 5000; ++k) {
      const Direction wi = random_direction(random), wo = random_direction(random);
      sum += std::fabs(table.eval(wi, wo)[0] / model.eval(wi, wo)[0] - 1);
    }
    return sum / 5000;
  };
  std::vector<double> errors;
  for (const GridSize size : {GridSize::paper, GridSize::standard}) {
    WriteOptions options;
    options.size = size;
    write_radiance_tree3(source(model), folder / "m.xml", options);
    errors.push_back(error(*open_brdf(folder / "m.xml").brdf));
  }
  CHECK(errors[1] < 0.7 * errors[0]);
  WriteOptions wanted;
  wanted.error = 0.06;
  const ExportNotes notes = write_radiance_tree3(source(model), folder / "m.xml", wanted);
  CHECK(error(*open_brdf(folder / "m.xml").brdf) < 0.08);  // over other directions than the writer's
  CHECK_FALSE(lost(notes, "not reached"));
  bool said = false;
  for (const auto& [key, words] : notes.facts) said |= key == "errors by divisions" && words.starts_with("16: ");
  CHECK(said);
}

TEST_CASE("The front is the sheet turned over: the same material seen from there") {
  const test::TemporaryFolder folder;
  for (const auto write : {write_radiance_klems_quarter, write_radiance_tree4}) {
    write(source(ward()), folder / "m.xml", small());
    ReadOptions front;
    front.assume = {{"side", "front"}};
    const Opened back_read = open_brdf(folder / "m.xml"), front_read = open_brdf(folder / "m.xml", front);
    test::Random random(test::seed);
    for (int k = 0; k < 2000; ++k) {
      const Direction wi = random_direction(random), wo = random_direction(random);
      CHECK(front_read.brdf->eval(wi, wo)[0] == Approx(back_read.brdf->eval(wi, wo)[0]).epsilon(2e-3));
    }
  }
}

TEST_CASE("Three channels are colour; grey stays grey; X, Y, Z and spectra become colour too") {
  const test::TemporaryFolder folder;
  for (const auto write : {write_radiance_klems_quarter, write_radiance_tree3}) {
    write(source(AnalyticBrdf("lambert", rgb_channels(), {{0.9}, {0.5}, {0.1}})), folder / "m.xml", small());
    const Opened read = open_brdf(folder / "m.xml");
    CHECK(read.brdf->channels() == rgb_channels());
    const auto f = read.brdf->eval(Direction::spherical(20_deg, 0_deg), Direction::spherical(50_deg, 100_deg));
    const double wanted[] = {0.9, 0.5, 0.1};
    for (std::size_t c = 0; c < 3; ++c) CHECK(f[c] == Approx(wanted[c] / std::numbers::pi).epsilon(1e-5));
  }
}

TEST_CASE("A matrix written again on its own patches is the same") {
  const test::TemporaryFolder folder;
  write_radiance_klems_quarter(source(ward()), folder / "a.xml", small());
  write_radiance_klems_quarter(open_brdf(folder / "a.xml"), folder / "b.xml", small());
  const auto a = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(folder / "a.xml").brdf),
             b = std::dynamic_pointer_cast<const KlemsTable>(open_brdf(folder / "b.xml").brdf);
  double worst = 0;
  for (std::size_t in = 0; in < 41; ++in)
    for (std::size_t out = 0; out < 41; ++out) worst = std::max(worst, std::fabs(b->value(0, in, out) / a->value(0, in, out) - 1));
  CHECK(worst < 1e-6);
}

TEST_CASE("Negative and unknown means are written as 0 and counted; too much energy is said; what cannot be written is refused") {
  const test::TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto write : {write_radiance_klems_quarter, write_radiance_tree4}) {
    CHECK(lost(write(source(Odd(-0.5)), folder / "m.xml", small()), "negative means are written as 0"));
    CHECK(lost(write(source(Odd(nan)), folder / "m.xml", small()), "of which nothing is known"));
    CHECK(lost(write(source(Odd(0.7)), folder / "m.xml", small()), "energy"));
    const Opened read = open_brdf(folder / "m.xml");
    CHECK(read.brdf->eval(Direction::spherical(60_deg, -135_deg), Direction())[0] == Approx(0.25));
  }
  CHECK(test::faults_of([&] { write_radiance_tree3(source(ward()), folder / "no.xml", small()); }).find("radiance-tree4 holds any") !=
        std::string::npos);
  Opened through = source(ggx(0.3));
  through.side = Side::transmission;
  CHECK(test::faults_of([&] { write_radiance_klems_full(through, folder / "no.xml", small()); }).find("the transmission") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "no.xml"));
}

TEST_CASE("Any number of threads writes the same XML") {
  const test::TemporaryFolder folder;
  for (const auto write : {write_radiance_klems_quarter, write_radiance_tree4}) {
    WriteOptions one = small(), three = small();
    one.threads = 1, three.threads = 3;
    write(source(ggx(0.2)), folder / "m.xml", one);
    const std::string first = test::read_file(folder / "m.xml");
    write(source(ggx(0.2)), folder / "m.xml", three);
    CHECK(test::read_file(folder / "m.xml") == first);
  }
}

TEST_CASE("The scene beside the file names it, and is written only where it is asked for") {
  const test::TemporaryFolder folder;
  WriteOptions options = small();
  const Opened grey = source(AnalyticBrdf("lambert", single_channel("value"), {{0.5}}));
  CHECK(write_radiance_klems_quarter(grey, folder / "grey.xml", options).files.size() == 1);
  options.scene = true;
  const ExportNotes notes = write_radiance_tree3(grey, folder / "grey.xml", options);
  REQUIRE(notes.files.size() == 2);
  CHECK(notes.files[1] == folder / "grey.rad");
  CHECK(test::read_file(folder / "grey.rad").find("6 0 grey.xml 0 0 1 .") != std::string::npos);
}
