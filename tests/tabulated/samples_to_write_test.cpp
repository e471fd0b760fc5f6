// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/samples_to_write.hpp"

#include <cmath>
#include <limits>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/direction_grid.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

Opened model() {
  Opened out;
  out.format = "test";
  out.brdf = std::make_shared<AnalyticBrdf>("ggx", rgb_channels(), std::vector<std::vector<double>>(3, {0.1, 0.5, 0.3, 0.2}));
  return out;
}

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

/// f = 1 to 60° from the normal and nothing beyond; certain to 1 % up to 30°, extrapolated from there.
class Cap final : public UncertainBrdf {
 public:
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {.isotropic = true, .bilateral = true, .reciprocal = false}; }
  using Brdf::eval;
  void eval(std::span<const Direction>, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wo.size(); ++k) f[k] = wo[k].z() > 0.5 ? 1 : std::numeric_limits<double>::quiet_NaN();
  }
  void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                             std::span<Coverage> coverage) const override {
    eval(wi, wo, f);
    for (std::size_t k = 0; k < wo.size(); ++k) {
      u[k] = std::isnan(f[k]) ? f[k] : 0.01;
      coverage[k] = std::isnan(f[k]) ? Coverage::unknown : wo[k].z() > 0.86 ? Coverage::interpolated : Coverage::extrapolated;
    }
  }

 private:
  Channels channels_ = single_channel("value");
};

}  // namespace

TEST_CASE("A model is sampled on the grid of the size; samples stay what they are") {
  ExportNotes notes;
  const auto sampled = samples_to_write(model(), paper(), notes);
  CHECK(sampled->size() == direction_grid(GridSize::paper, model().brdf->symmetry()).pairs().size());
  CHECK(notes.n_nodes == sampled->size());
  for (std::size_t k = 0; k < sampled->size(); k += 97)
    CHECK(sampled->f[1][k] == model().brdf->eval(sampled->angles[k].wi(), sampled->angles[k].wo())[1]);

  Opened samples = model();
  samples.dataset = sampled;
  ExportNotes again;
  CHECK(samples_to_write(samples, {}, again) == sampled);
  CHECK(again.n_nodes == sampled->size());
}

TEST_CASE("Uncertainty and coverage of the source stand beside its values; what it does not know is left out") {
  Opened opened;
  opened.uncertain = std::make_shared<Cap>();
  opened.brdf = opened.uncertain;
  ExportNotes notes;
  const auto sampled = samples_to_write(opened, paper(), notes);
  CHECK(notes.n_unknown > 0);
  CHECK(sampled->size() + notes.n_unknown == notes.n_nodes);
  CHECK(sampled->u[0][0] == 0.01);
  CHECK(sampled->extra.at("coverage").front() == 1);
  CHECK(sampled->extra.at("coverage").back() == 2);
  CHECK(notes.n_extrapolated > 0);
}

TEST_CASE("A source of nothing is refused") {
  ExportNotes notes;
  CHECK(test::faults_of([&] { samples_to_write({}, {}, notes); }).find("cannot be evaluated") != std::string::npos);
}

TEST_CASE("The other side of bilateral samples is added where all of them lie on one") {
  Dataset data;
  data.channels = single_channel("value");
  data.symmetry = {.isotropic = true, .bilateral = true, .reciprocal = false};
  data.angles = {{30_deg, 10_deg, 40_deg, 190_deg}, {30_deg, 10_deg, 40_deg, 100_deg}, {0_deg, 0_deg, 40_deg, 100_deg}};
  data.f = {{1, 2, 3}}, data.u = {{0.1, 0.2, 0.3}}, data.extra["n"] = {4, 5, 6};
  const auto half = std::make_shared<const Dataset>(data);
  const auto both = with_both_sides(half);
  both->require_consistent();
  REQUIRE(both->size() == 4);
  CHECK(both->f[0][3] == 2);
  CHECK(both->u[0][3] == 0.2);
  CHECK(both->extra.at("n")[3] == 5);
  CHECK(both->angles[3].phi_o.degrees() == -80);
  CHECK(with_both_sides(both) == both);
  data.symmetry.bilateral = false;
  const auto other = std::make_shared<const Dataset>(data);
  CHECK(with_both_sides(other) == other);
}

TEST_CASE("Every BRDF goes into our table and into csv and comes back the same at the nodes") {
  // The table is of floats.
  constexpr double to_float = 6e-8;
  const test::TemporaryFolder scratch;
  ExportNotes notes;
  const auto sampled = samples_to_write(model(), paper(), notes);
  for (const Format& format : formats()) {
    const std::string name = format.name;
    if (name != "csv" && name != "brdf-exr") continue;
    const std::filesystem::path path = scratch / (name + format.extension);
    format.write(model(), path, paper());
    const Opened read = open_brdf(path);
    CHECK(read.format == name);
    REQUIRE(read.dataset->size() == sampled->size());
    for (std::size_t k = 0; k < sampled->size(); k += 31) {
      const GonioAngles& at = sampled->angles[k];
      CHECK(read.brdf->eval(at.wi(), at.wo())[0] == Approx(model().brdf->eval(at.wi(), at.wo())[0]).epsilon(to_float));
    }
  }
}
