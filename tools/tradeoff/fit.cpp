// SPDX-License-Identifier: BSD-3-Clause
// Topic fit: parameters of a lobe from a noisy table, from all samples, collapsed rows or a part of the samples; milliseconds against
// error.
#include "fitting/fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

constexpr std::size_t rows = 90;
constexpr int seeds = 5;

/// Samples on rows of constant θh, spaced as in a MERL table; every `stride`-th of them, the constancy told or hidden.
class Table final : public Observations {
 public:
  Table(const AnalyticBrdf& truth, std::size_t per_row, int seed_number) : channels_(truth.channels()) {
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(seed_number));
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    for (std::size_t row = 0; row < rows; ++row) {
      const double cell = static_cast<double>(row) + 0.5;
      const Angle theta_h = degrees(cell * cell / 90);
      for (std::size_t k = 0; k < per_row;) {
        const DirectionPair pair = directions({theta_h, degrees(0), degrees(90 * uniform(random)), degrees(180 * uniform(random))});
        // Rows near 90° hold few pairs above the horizon: what is left of them stands at θd near 0.
        if (!(pair.wi.z() > 0.02) || !(pair.wo.z() > 0.02)) {
          if (row < 80) continue;
          break;
        }
        const double f = truth.eval(pair.wi, pair.wo)[0];
        geometry_.push_back(lobe_geometry(pair.wi, pair.wo));
        geometry_.back().log_cos_h = std::log(theta_h.cos());
        angles_.push_back(gonio_angles(pair.wi, pair.wo));
        value_.push_back(f + std::hypot(0.01 * f, 1e-4) * normal(random));
        ++k;
      }
      end_.push_back(value_.size());
    }
  }
  /// Another look at the same samples.
  Table(const Table& all, std::size_t stride, bool tell_rows) : channels_(all.channels_), tell_rows_(tell_rows) {
    std::size_t first = 0;
    for (const std::size_t end : all.end_) {
      for (std::size_t k = first + stride / 2; k < end; k += stride) {
        geometry_.push_back(all.geometry_[k]), angles_.push_back(all.angles_[k]), value_.push_back(all.value_[k]);
      }
      first = end;
      if (end_.empty() ? !value_.empty() : value_.size() > end_.back()) end_.push_back(value_.size());
    }
  }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {true, true, true}; }
  std::size_t block_count() const override { return end_.size(); }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock out;
    out.size = end_[index] - begin(index);
    if (tell_rows_) out.constant = ConstantOver::theta_h, out.log_cos_h = geometry_[begin(index)].log_cos_h;
    out.f.push_back({value_.data() + begin(index)});
    return out;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override { copy(geometry_, index, out); }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override { copy(angles_, index, out); }
  std::size_t size() const { return value_.size(); }
  const std::vector<double>& values() const { return value_; }

 private:
  std::size_t begin(std::size_t index) const { return index == 0 ? 0 : end_[index - 1]; }
  template <class T>
  void copy(const std::vector<T>& from, std::size_t index, std::vector<T>& out) const {
    out.assign(from.begin() + static_cast<std::ptrdiff_t>(begin(index)), from.begin() + static_cast<std::ptrdiff_t>(end_[index]));
  }
  Channels channels_;
  bool tell_rows_ = false;
  std::vector<LobeGeometry> geometry_;
  std::vector<GonioAngles> angles_;
  std::vector<double> value_;
  std::vector<std::size_t> end_;
};

struct Way {
  std::string method, setting;
  std::size_t stride;
  bool tell_rows;
};

struct Case {
  std::string panel, model, parameter;
  AnalyticBrdf truth;
  double wanted;
  std::vector<Way> ways;
};

double value_of(const fitting::FitResult& result, const std::string& name) {
  for (const auto& p : result.parameters)
    if (p.name == name) return p.value;
  return NAN;
}

double relative_sigma(const fitting::FitResult& result, const std::string& name) {
  for (const auto& p : result.parameters)
    if (p.name == name && p.sigma) return *p.sigma / p.value;
  return 1e-6;
}

}  // namespace

Measured measure_fit(const Effort& effort) {
  Measured out;
  out.title = "Fit of a lobe to a noisy table: error of its width against time (rms over five noises of 1 %)";
  out.time_of = "time per fit";
  out.error_of = "relative error of s or alpha";
  out.time_unit_s = 1e-3, out.time_unit = "ms";
  out.targets = {1e-2, 1e-3, 2e-4};
  const std::size_t per_row = effort.quick ? 500 : 3000;
  std::vector<Way> parts;
  for (const std::size_t stride : {1, 4, 16, 64})
    parts.push_back(
        {stride == 1 ? "every sample" : "a part of the samples", stride == 1 ? "" : fmt::format("1 of {}", stride), stride, false});
  std::vector<Way> collapsed = parts;
  collapsed.push_back({"rows collapsed", "", 1, true});
  const Channels one = single_channel("f");
  const std::vector<Case> cases{
      {"Blinn-Phong, s = 2000", "blinn-phong-ngan", "s", AnalyticBrdf("blinn-phong-ngan", one, {{0.2, 0.3, 2000}}), 2000, collapsed},
      {"GGX + Schlick, alpha = 0.1", "ggx", "alpha", AnalyticBrdf("ggx", one, {{0.2, 0.05, 0.9, 0.1}}), 0.1, parts}};
  double done = 0, all = 0;
  for (const Case& which : cases) all += static_cast<double>(which.ways.size());
  for (const Case& which : cases) {
    std::vector<std::unique_ptr<Table>> tables;
    for (int k = 0; k < seeds; ++k) tables.push_back(std::make_unique<Table>(which.truth, per_row, k));
    const Timing sum = time_of(
        [&] {
          double total = 0;
          for (const double value : tables[0]->values()) total += value;
          return total;
        },
        1, 1e-3);
    Panel panel;
    panel.name = fmt::format("{}, {} samples", which.panel, tables[0]->size());
    panel.time_limit = {sum.median_s, "adding up the samples"};
    for (const Way& way : which.ways) {
      effort.progress(done++ / all, fmt::format("{}: {} {}", panel.name, way.method, way.setting));
      double square = 0;
      std::vector<double> seconds;
      fitting::FitOptions options;
      options.model = which.model;
      for (const auto& table : tables) {
        const Table view(*table, way.stride, way.tell_rows);
        const fitting::FitResult result = fitting::fit(view, options);
        const double error = value_of(result, which.parameter) / which.wanted - 1;
        square += error * error / seeds;
        seconds.push_back(result.fit_s);
        if (way.stride == 1 && panel.error_floors.empty()) {
          const double sigma = relative_sigma(result, which.parameter);
          panel.error_floors = {{sigma, fmt::format("noise: one sigma of all samples, {:.1e}", sigma)}};
        }
      }
      Point point;
      point.panel = panel.name, point.method = way.method, point.setting = way.setting;
      if (std::isfinite(square)) point.error = std::sqrt(square);
      point.worst_at = "rms over five noises";
      point.time = timing_of(std::move(seconds));
      out.points.push_back(std::move(point));
    }
    out.panels.push_back(std::move(panel));
  }
  return out;
}

}  // namespace gonio::tools::tradeoff
