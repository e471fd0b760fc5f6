// SPDX-License-Identifier: BSD-3-Clause
// Topic fit: the width of a lobe from a noisy table, by a solver on all samples at several tolerances, by the profile on all samples or a
// part of them, or from collapsed rows; milliseconds against the distance from the least-squares optimum of all samples.
#include "fitting/fit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "fitting/polish.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

constexpr std::size_t rows = 90;
constexpr int seeds = 5;
constexpr int threads = 2;
constexpr double rounding = 1e-12;  // below it no distance from the optimum can be told from another

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
        u_.push_back(std::hypot(0.01 * f, 1e-4));
        value_.push_back(f + u_.back() * normal(random));
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
        u_.push_back(all.u_[k]);
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
    out.u.push_back({u_.data() + begin(index)});
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
  std::vector<double> value_, u_;
  std::vector<std::size_t> end_;
};

struct Way {
  std::string method, setting;
  std::size_t stride = 1;
  bool tell_rows = false;
  double tolerance = 0;  ///< of the solver on all samples; 0: the profile
};

struct Case {
  std::string panel, model, parameter;
  AnalyticBrdf truth;
  std::vector<Way> ways;
};

/// Levenberg-Marquardt on every sample and all parameters at once, as one writes it without thinking of the structure of the problem.
fitting::Polished solve_directly(const Observations& samples, const std::string& model, const std::vector<double>& linear,
                                 const std::vector<double>& theta, double tolerance) {
  const fitting::Terms terms = fitting::make_terms(samples, fitting::model_kernel(model), fitting::Metric::linear, threads);
  constexpr double free = std::numeric_limits<double>::quiet_NaN();
  const std::vector<fitting::LinearLimits> limits{{std::vector<double>(linear.size(), free), {}, {}}};
  const std::vector<fitting::Wanted> wanted(theta.size(), {free, free, free});
  const fitting::SearchSpace space(terms.kernel, wanted, std::vector<bool>(terms.kernel.info->terms.size(), true));
  return fitting::polish(terms, space, limits, {linear}, theta, threads, 200, tolerance);
}

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
  out.title = "Fit of a lobe to a noisy table: distance of its width from the optimum of all samples (rms over five noises)";
  out.time_of = "time per fit, intervals included where there are any";
  out.error_of = "relative distance of s or alpha from the optimum";
  out.time_unit_s = 1e-3, out.time_unit = "ms";
  out.targets = {1e-2, 1e-4, 1e-6};
  const std::size_t per_row = effort.quick ? 300 : 3000;
  std::vector<Way> ways;
  for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6, 1e-10})
    ways.push_back({"solver on all samples", fmt::format("tolerance {:.0e}", tolerance), 1, false, tolerance});
  for (const std::size_t stride : {1u, 4u, 16u, 64u})
    ways.push_back({stride == 1 ? "profile on all samples" : "profile on a part of the samples",
                    stride == 1 ? "" : fmt::format("1 of {}", stride), stride, false, 0});
  std::vector<Way> with_rows = ways;
  with_rows.push_back({"profile on collapsed rows", "", 1, true, 0});
  const Channels one = single_channel("f");
  const std::vector<Case> cases{
      {"Blinn-Phong, s = 2000", "blinn-phong-ngan", "s", AnalyticBrdf("blinn-phong-ngan", one, {{0.2, 0.3, 2000}}), with_rows},
      {"GGX + Schlick, alpha = 0.1", "ggx", "alpha", AnalyticBrdf("ggx", one, {{0.2, 0.05, 0.9, 0.1}}), ways}};
  double done = 0, all = 0;
  for (const Case& which : cases) all += static_cast<double>(which.ways.size());
  for (const Case& which : cases) {
    std::vector<std::unique_ptr<Table>> tables;
    std::vector<double> optimum;
    fitting::FitOptions options;
    options.model = which.model;
    options.threads = threads;
    Panel panel;
    for (int k = 0; k < seeds; ++k) {
      tables.push_back(std::make_unique<Table>(which.truth, per_row, k));
      const fitting::FitResult result = fitting::fit(Table(*tables.back(), 1, false), options);
      const auto split = result.values[0].begin() + static_cast<std::ptrdiff_t>(which.truth.model().linear_count);
      optimum.push_back(
          solve_directly(*tables.back(), which.model, {result.values[0].begin(), split}, {split, result.values[0].end()}, 1e-16).theta[0]);
      if (k == 0) {
        const double sigma = relative_sigma(result, which.parameter);
        panel.error_floors = {{sigma, fmt::format("noise of the data, one sigma: {:.1e}", sigma)}, {rounding, "rounding of the sums"}};
      }
    }
    const Timing sum = time_of(
        [&] {
          double total = 0;
          for (const double value : tables[0]->values()) total += value;
          return total;
        },
        1, 1e-3);
    panel.name = fmt::format("{}, {} samples", which.panel, tables[0]->size());
    panel.limit = {sum.median_s, "adding up the samples"};
    for (const Way& way : which.ways) {
      effort.progress(done++ / all, fmt::format("{}: {} {}", panel.name, way.method, way.setting));
      double square = 0;
      std::vector<double> seconds;
      for (std::size_t k = 0; k < tables.size(); ++k) {
        const Table view(*tables[k], way.stride, way.tell_rows);
        const auto start = std::chrono::steady_clock::now();
        const std::size_t linear = which.truth.model().linear_count;
        const double value = way.tolerance > 0 ? solve_directly(view, which.model, std::vector<double>(linear, 0.1),
                                                                {which.truth.model().parameters[linear].example}, way.tolerance)
                                                     .theta[0]
                                               : value_of(fitting::fit(view, options), which.parameter);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        const double error = value / optimum[k] - 1;
        square += error * error / seeds;
      }
      Point point;
      point.panel = panel.name, point.method = way.method, point.setting = way.setting;
      if (std::isfinite(square)) point.error = std::max(std::sqrt(square), rounding);
      point.worst_at = "rms over five noises";
      point.time = timing_of(std::move(seconds));
      out.points.push_back(std::move(point));
    }
    out.panels.push_back(std::move(panel));
  }
  return out;
}

}  // namespace gonio::tools::tradeoff
