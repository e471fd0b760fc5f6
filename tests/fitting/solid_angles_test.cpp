// SPDX-License-Identifier: BSD-3-Clause
// Weights by solid angle make sums over samples integrals over the hemispheres.
#include "fitting/solid_angles.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// Σ weight value / Σ weight over the samples of observations above the horizon.
template <class Value>
double mean(const Observations& observations, Value&& value) {
  const std::vector<double> weight = solid_angles(observations);
  double sum = 0, total = 0;
  std::size_t k = 0;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    std::vector<LobeGeometry> geometry;
    observations.geometry(b, geometry);
    for (const LobeGeometry& g : geometry) {
      const double w = g.cos_i >= 0 && g.cos_o >= 0 ? weight[k] : 0;
      sum += w * value(g), total += w, ++k;
    }
  }
  CHECK(k == weight.size());
  return sum / total;
}

/// θh in steps of √θh at their left edges, as a MERL file has it, θd and φd in equal steps.
class Table final : public Observations {
 public:
  static constexpr std::size_t halves = 90, differences = 45, azimuths = 60;
  Table() : channels_(single_channel("Y")), f_(differences * azimuths, .1) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {true, true, true}; }
  std::size_t block_count() const override { return halves; }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock block;
    block.size = f_.size();
    block.constant = ConstantOver::theta_h;
    block.log_cos_h = std::log(theta_h(index).cos());
    block.f = {{f_.data()}};
    return block;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override {
    out.clear();
    for (std::size_t k = 0; k < f_.size(); ++k) {
      const DirectionPair pair = pair_of(index, k);
      out.push_back(lobe_geometry(pair.wi, pair.wo));
    }
  }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override {
    out.clear();
    for (std::size_t k = 0; k < f_.size(); ++k) {
      const DirectionPair pair = pair_of(index, k);
      out.push_back(gonio_angles(pair.wi, pair.wo));
    }
  }

 private:
  static Angle theta_h(std::size_t index) {
    const double part = static_cast<double>(index) / halves;
    return degrees(90 * part * part);
  }
  static DirectionPair pair_of(std::size_t index, std::size_t k) {
    return directions({theta_h(index), degrees(0), degrees(90.0 * static_cast<double>(k / azimuths) / differences),
                       degrees(180.0 * static_cast<double>(k % azimuths) / azimuths)});
  }
  Channels channels_;
  std::vector<double> f_;
};

double both_cosines(const LobeGeometry& g) { return g.cos_i * g.cos_o; }

}  // namespace

TEST_CASE("a grid of angles weighed by solid angle integrates over both hemispheres") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  for (int theta_i = 0; theta_i <= 90; theta_i += 5)
    for (int theta_o = 0; theta_o <= 90; theta_o += 5)
      for (int phi = 0; phi < 360; phi += 15) {
        data->angles.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi)});
        if (theta_o == 0) break;  // one reading at the pole
      }
  data->f.assign(1, std::vector<double>(data->angles.size(), .1));
  const auto observations = observe(data);
  // The mean of cos θi cos θo over the hemispheres is 1/4; cells of 5° are good to a part in a thousand.
  CHECK(mean(*observations, both_cosines) == Approx(.25).epsilon(2e-3));
  CHECK(mean(*observations, [](const LobeGeometry& g) { return g.cos_i * g.cos_i; }) == Approx(1 / 3.).epsilon(5e-3));
}

TEST_CASE("a table of half-difference angles is weighed with the Jacobian of the half vector") {
  CHECK(mean(Table(), both_cosines) == Approx(.25).epsilon(5e-3));
  CHECK(mean(Table(), [](const LobeGeometry& g) { return g.cos_d * g.cos_d; }) ==
        Approx(.5 + .125).epsilon(1e-2));  // (1 + cos of the angle between two independent directions)/2, whose mean is 1/4
}

TEST_CASE("readings of one node share its cell, and what a drive misses a node by does not matter") {
  const std::vector<GonioAngles> grid = polar_grid({20, 40, 60}, 10, 30);
  auto once = std::make_shared<Dataset>(), twice = std::make_shared<Dataset>();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> miss(-.004, .004);
  for (const GonioAngles& a : grid) {
    once->angles.push_back(a);
    for (int k = 0; k < 2; ++k)
      twice->angles.push_back({degrees(a.theta_i.degrees() + miss(random)), degrees(a.phi_i.degrees() + miss(random)),
                               degrees(std::abs(a.theta_o.degrees() + miss(random))), degrees(a.phi_o.degrees() + miss(random))});
  }
  for (const auto& data : {once, twice}) data->channels = single_channel("Y"), data->f.assign(1, std::vector<double>(data->size(), .1));
  const std::vector<double> one = solid_angles(*observe(once)), two = solid_angles(*observe(twice));
  for (std::size_t k = 0; k < one.size(); ++k) CHECK(two[2 * k] + two[2 * k + 1] == Approx(2 * one[k]).epsilon(2e-3));
}

TEST_CASE("scattered directions have no solid angles") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> theta(0, 80), phi(0, 360);
  for (int k = 0; k < 200; ++k) data->angles.push_back({degrees(theta(random)), degrees(0), degrees(theta(random)), degrees(phi(random))});
  data->f.assign(1, std::vector<double>(200, .1));
  try {
    solid_angles(*observe(data));
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    CHECK(error.faults().at(0).found.find("scattered") != std::string::npos);
  }
}

TEST_CASE("a fit weighed by solid angle is that of the same data with u to match, whatever u they have") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({10, 40, 70}, 10, 30), {1e-3, 0, .05}, 4);
  FitOptions options;
  options.metric = Metric::linear;
  options.weights = Weights::solid_angle;
  const FitResult measured = fit(*observe(data), options);
  CHECK(measured.weighting.source == WeightSource::solid_angle);
  CHECK(!measured.errors.chi2_per_dof);
  const std::vector<double> weight = solid_angles(*observe(data));
  for (std::size_t k = 0; k < weight.size(); ++k) data->u[0][k] = 1 / std::sqrt(weight[k]);
  options.weights = Weights::uncertainty;
  const FitResult stated = fit(*observe(data), options);
  for (std::size_t k = 0; k < 3; ++k) CHECK(measured.values[0][k] == Approx(stated.values[0][k]).epsilon(1e-7));
  // A different minimum from that of equal weights.
  options.weights = Weights::none;
  CHECK(std::abs(fit(*observe(data), options).values[0][2] / measured.values[0][2] - 1) > 1e-4);
  options.weights = Weights::solid_angle;
  options.robust = Robust::huber;
  CHECK_THROWS_AS(fit(*observe(data), options), Error);
}

TEST_CASE("rows of a table keep the weights of their samples") {
  const Table table;
  FitOptions options;
  options.model = "lambert";
  options.metric = Metric::linear;
  options.weights = Weights::solid_angle;
  const FitResult result = fit(table, options);
  CHECK(result.values[0][0] == Approx(.1 * 3.14159265358979).epsilon(1e-12));
  CHECK(result.n_observations == Table::halves * Table::differences * Table::azimuths);
}

TEST_CASE("weights none is the fit of the data without their uncertainties") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({10, 40, 70}, 10, 30), {1e-3, 1e-4, .05}, 4);
  data->u[0][5] = std::numeric_limits<double>::quiet_NaN();  // no reason to leave a value out
  for (const std::optional<Metric> metric : {std::optional<Metric>(), std::optional(Metric::linear), std::optional(Metric::cbrt)}) {
    FitOptions options;
    options.metric = metric;
    options.weights = Weights::none;
    const FitResult without_weights = fit(*observe(data), options);
    auto bare = std::make_shared<Dataset>(*data);
    bare->u.clear();
    const FitResult without_u = fit(*observe(bare), options);
    CHECK(without_weights.weighting.source == WeightSource::none);
    CHECK(without_weights.n_observations == data->size());
    CHECK(!without_weights.errors.chi2_per_dof);
    REQUIRE(without_weights.parameters.size() == without_u.parameters.size());
    for (std::size_t k = 0; k < without_u.parameters.size(); ++k) {
      CHECK(without_weights.parameters[k].value == without_u.parameters[k].value);
      CHECK(without_weights.parameters[k].low == without_u.parameters[k].low);
      CHECK(without_weights.parameters[k].high == without_u.parameters[k].high);
    }
    CHECK(without_weights.errors.linear == without_u.errors.linear);
    if (metric) {
      options.weights = Weights::automatic;
      CHECK(fit(*observe(data), options).values[0][2] != without_u.values[0][2]);
    }
  }
}
