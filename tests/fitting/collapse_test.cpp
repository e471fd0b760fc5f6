// SPDX-License-Identifier: BSD-3-Clause
// A table collapsed to one row per block has the cost of its samples, and takes milliseconds.
#include "fitting/collapse.hpp"

#include <chrono>
#include <cmath>
#include <cstring>

#include "fitting/fit.hpp"
#include "fitting/profile.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// Blocks of constant theta_h in memory, as a MERL file lays them out: three planes of doubles, scaled, -1 where there is no value, and
/// one byte off alignment. `announce` false hides that the blocks are constant, so that every sample becomes a row.
class Table final : public Observations {
 public:
  Table(std::size_t blocks, std::size_t per_block, bool announce, double noise)
      : blocks_(blocks), per_block_(per_block), announce_(announce) {
    const AnalyticBrdf truth("blinn-phong", rgb_channels(), {{.2, .3, 200}, {.1, .2, 200}, {.3, .1, 200}});
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    bytes_.resize(1 + 3 * blocks * per_block * sizeof(double));
    for (std::size_t b = 0; b < blocks; ++b)
      for (std::size_t k = 0; k < per_block; ++k) {
        const std::vector<double> f = truth.eval(angles_of(b, k));
        const bool missing = (b * 7 + k) % 11 == 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double stored = missing ? -1 : f[c] * (1 + noise * normal(random)) / scale;
          std::memcpy(at(c, b, k), &stored, sizeof stored);
        }
      }
  }
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {true, true, true}; }
  std::size_t block_count() const override { return blocks_; }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock block;
    block.size = per_block_;
    block.constant = announce_ ? ConstantOver::theta_h : ConstantOver::nothing;
    block.log_cos_h = lobe_geometry(angles_of(index, 0)).log_cos_h;
    for (std::size_t c = 0; c < 3; ++c) block.f.push_back({const_cast<Table*>(this)->at(c, index, 0), 1, Column::Type::f64, scale});
    block.validity = ObservationBlock::Validity::no_channel_negative;
    return block;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override {
    out.clear();
    for (std::size_t k = 0; k < per_block_; ++k) out.push_back(lobe_geometry(angles_of(index, k)));
  }
  void geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const override {
    out.clear();
    for (const std::size_t k : samples) out.push_back(lobe_geometry(angles_of(index, k)));
  }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override {
    out.clear();
    for (std::size_t k = 0; k < per_block_; ++k) out.push_back(angles_of(index, k));
  }

 private:
  static constexpr double scale = 1.0 / 1500;
  unsigned char* at(std::size_t c, std::size_t b, std::size_t k) {
    return bytes_.data() + 1 + ((c * blocks_ + b) * per_block_ + k) * sizeof(double);
  }
  GonioAngles angles_of(std::size_t b, std::size_t k) const {
    const double theta_h = 60.0 * std::pow(static_cast<double>(b) / static_cast<double>(blocks_), 2);
    const double theta_d = 25.0 * static_cast<double>(k) / static_cast<double>(per_block_);
    return {degrees(theta_h + theta_d), degrees(0), degrees(theta_h - theta_d), degrees(0)};
  }
  std::size_t blocks_, per_block_;
  bool announce_;
  Channels channels_ = rgb_channels();
  std::vector<unsigned char> bytes_;
};

}  // namespace

TEST_CASE("the collapsed cost is the cost of all samples, for every metric that collapses") {
  const Table blocks(90, 50, true, .01), samples(90, 50, false, .01);
  for (const Metric metric : {Metric::linear, Metric::linear_cos, Metric::log, Metric::cbrt}) {
    const Terms small = make_terms(blocks, model_kernel("blinn-phong"), metric, 2);
    const Terms large = make_terms(samples, model_kernel("blinn-phong"), metric, 2);
    INFO(name(metric));
    REQUIRE(small.collapsed);
    REQUIRE(!large.collapsed);
    CHECK(small.rows() == 90);
    CHECK(small.n_observations == large.n_observations);
    CHECK(small.not_fitted == large.not_fitted);
    CHECK(small.not_fitted.total() > 400);
    const std::vector<LinearLimits> free(3, LinearLimits{std::vector<double>(2, std::nan("")), {}, {}});
    for (const double s : {1.0, 180.0, 1e4})
      CHECK(Profile(small, free).at(std::vector{s}).cost == Approx(Profile(large, free).at(std::vector{s}).cost).epsilon(1e-12));
  }
}

TEST_CASE("log1p and a mirror lobe are not collapsed") {
  const Table table(90, 50, true, .01);
  CHECK(!make_terms(table, model_kernel("blinn-phong"), Metric::log1p, 1).collapsed);
  CHECK(!make_terms(table, model_kernel("phong"), Metric::linear, 1).collapsed);
  CHECK(make_terms(table, model_kernel("lambert"), Metric::linear, 1).collapsed);
}

TEST_CASE("a fit of blocks is the fit of their samples") {
  FitOptions by_name;
  by_name.metric = Metric::linear;
  const FitResult blocks = fit(Table(90, 50, true, .01), by_name), samples = fit(Table(90, 50, false, .01), by_name);
  REQUIRE(blocks.parameters.size() == samples.parameters.size());
  for (std::size_t k = 0; k < blocks.parameters.size(); ++k) {
    INFO(blocks.parameters[k].name);
    CHECK(blocks.parameters[k].value == Approx(samples.parameters[k].value).epsilon(1e-7));
    CHECK(*blocks.parameters[k].low == Approx(*samples.parameters[k].low).epsilon(1e-5));
    CHECK(*blocks.parameters[k].high == Approx(*samples.parameters[k].high).epsilon(1e-5));
  }
  CHECK(blocks.errors.log == Approx(samples.errors.log).epsilon(1e-7));
}

TEST_CASE("a table of a million and a half cells in three channels is fitted in a moment", "[.timing]") {
  const Table table(90, 16200, true, .01);
  for (int run = 0; run < 5; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    const Terms terms = make_terms(table, model_kernel("blinn-phong"), Metric::linear, 2);
    const double collapse_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const FitResult result = fit(table, {});
    WARN("collapse " << collapse_s * 1e3 << " ms, fit " << result.fit_s * 1e3 << " ms, rows " << terms.rows());
    CHECK(result.values[0][2] == Approx(200).epsilon(1e-3));
  }
}
