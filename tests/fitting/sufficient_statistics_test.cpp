// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/sufficient_statistics.hpp"

#include <cmath>

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "fitting/joint_observations.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr double sum_rounding = 1e-12;

std::shared_ptr<const Observations> data(unsigned seed, const std::vector<double>& incidences, bool with_u) {
  auto out = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 40), test::polar_grid(incidences, 5, 15), {.relative = 0.02}, seed);
  if (!with_u) out->u.clear();
  return observe(out);
}

void check_same(const FitResult& a, const FitResult& b, double value_rounding) {
  REQUIRE(a.status == Status::converged);
  REQUIRE(b.status == Status::converged);
  CHECK(a.n_observations == b.n_observations);
  REQUIRE(a.parameters.size() == b.parameters.size());
  for (std::size_t k = 0; k < a.parameters.size(); ++k) {
    INFO(a.parameters[k].name);
    CHECK(a.parameters[k].value == Approx(b.parameters[k].value).epsilon(value_rounding));
    CHECK(a.parameters[k].kind == b.parameters[k].kind);
  }
}

/// θh rows as a table has them: blocks over which it is constant.
class TableRows final : public Observations {
 public:
  TableRows(unsigned seed, std::size_t rows, std::size_t width) : width_(width) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (std::size_t r = 0; r < rows; ++r) {
      log_cosine_.push_back(std::log(std::cos(1.5 * std::pow(static_cast<double>(r) / static_cast<double>(rows), 2))));
      const double f = 0.2 / M_PI + 0.3 * 108 / (8 * M_PI) * std::exp(100 * log_cosine_.back());
      for (std::size_t k = 0; k < width; ++k) value_.push_back(f * (1 + 0.01 * normal(random)));
    }
  }
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  std::size_t block_count() const override { return log_cosine_.size(); }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock out;
    out.size = width_;
    out.constant = ConstantOver::theta_h;
    out.log_cos_h = log_cosine_[index];
    out.f.push_back({value_.data() + index * width_});
    return out;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override {
    LobeGeometry geometry;
    geometry.log_cos_h = log_cosine_[index];
    out.assign(width_, geometry);
  }
  void angles(std::size_t, std::vector<GonioAngles>& out) const override { out.assign(width_, {}); }

 private:
  std::size_t width_;
  Channels channels_ = single_channel("Y");
  std::vector<double> log_cosine_, value_;
};

}  // namespace

TEST_CASE("statistics of parts, merged, fit as the samples of all parts together do") {
  struct Case {
    const char* model;
    std::optional<Metric> metric;
    bool with_u;
  };
  for (const Case& c :
       {Case{"blinn-phong", Metric::linear, true}, Case{"blinn-phong", Metric::linear, false}, Case{"phong", Metric::cbrt, false},
        Case{"phong", Metric::linear_cos, false}, Case{"blinn-phong", Metric::log, false}, Case{"lambert", Metric::linear, true}}) {
    INFO(c.model << ' ' << name(c.metric.value_or(Metric::linear)) << ' ' << c.with_u);
    FitOptions options;
    options.model = c.model;
    options.metric = c.metric;
    const auto a = data(1, {10, 30}, c.with_u), b = data(2, {50}, c.with_u), d = data(3, {10, 30, 50}, c.with_u);
    const SufficientStatistics merged =
        merge({sufficient_statistics(*a, options), sufficient_statistics(*b, options), sufficient_statistics(*d, options)});
    const FitResult together = fit(*join({a, b, d}), options), from_parts = fit(merged, options);
    // Other sums, other rounding: where the minimum is flat to rounding, the exponent is known to its square root only.
    check_same(from_parts, together, 1e-7);
    // One set of statistics of all samples, and the merged one, are the same sums.
    const FitResult whole = fit(sufficient_statistics(*join({a, b, d}), options), options);
    for (std::size_t k = 0; k < whole.parameters.size(); ++k)
      if (whole.parameters[k].name != "s") CHECK(from_parts.parameters[k].value == Approx(whole.parameters[k].value).epsilon(1e-8));
    CHECK(*from_parts.parameters[0].low == Approx(*together.parameters[0].low).epsilon(1e-5));
    if (c.with_u) CHECK(*from_parts.errors.chi2_per_dof == Approx(*together.errors.chi2_per_dof).epsilon(1e-9));
  }
}

TEST_CASE("rows of tables stay as they are, so that merging is exact to the last digit with every default") {
  const auto a = std::make_shared<const TableRows>(1, 60, 200), b = std::make_shared<const TableRows>(2, 60, 300);
  const FitOptions options;
  const SufficientStatistics merged = merge({sufficient_statistics(*a, options), sufficient_statistics(*b, options)});
  CHECK(merged.rows == SufficientStatistics::Rows::table_rows);
  CHECK(merged.row_count() == 120);
  const FitResult together = fit(*join({a, b}), options), from_parts = fit(merged, options);
  check_same(from_parts, together, sum_rounding);
  CHECK(*from_parts.parameters[2].low == Approx(*together.parameters[2].low).epsilon(sum_rounding));
  CHECK(from_parts.errors.linear == Approx(together.errors.linear).epsilon(1e-9));
  CHECK(from_parts.weighting.source == together.weighting.source);
}

TEST_CASE("sums of parts are the sums of the whole") {
  FitOptions options;
  options.metric = Metric::linear;
  options.model = "phong";
  const auto a = data(1, {10, 30}, true), b = data(2, {30, 50}, true);
  const SufficientStatistics merged = merge({sufficient_statistics(*a, options), sufficient_statistics(*b, options)});
  const SufficientStatistics whole = sufficient_statistics(*join({a, b}), options);
  REQUIRE(merged.row_count() == whole.row_count());
  CHECK(merged.n_observations == whole.n_observations);
  for (std::size_t k = 0; k < whole.row_count(); ++k) {
    CHECK(merged.log_cosine[k] == whole.log_cosine[k]);
    CHECK(merged.channel[0].weight[k] == Approx(whole.channel[0].weight[k]).epsilon(sum_rounding));
    CHECK(merged.channel[0].mean[k] == Approx(whole.channel[0].mean[k]).epsilon(sum_rounding));
    CHECK(merged.channel[0].within[k] == Approx(whole.channel[0].within[k]).epsilon(1e-9).margin(1e-12));
    CHECK(merged.channel[0].count[k] == whole.channel[0].count[k]);
  }
  // Mirrored directions have the same angle to the mirror direction: there are fewer rows than samples.
  CHECK(whole.row_count() < whole.n_observations);
}

TEST_CASE("a model of all angles keeps directions, and its statistics serve any other model") {
  FitOptions options;
  options.metric = Metric::linear;
  const auto a = data(1, {10, 30}, false), b = data(2, {10, 30}, false);
  options.model = "ggx";
  const SufficientStatistics merged = merge({sufficient_statistics(*a, options), sufficient_statistics(*b, options)});
  CHECK(merged.row_count() * 2 == merged.n_observations);
  for (const char* model : {"ggx", "phong", "blinn-phong"}) {
    INFO(model);
    options.model = model;
    check_same(fit(merged, options), fit(*join({a, b}), options), 1e-6);
  }
  options.metric = Metric::log1p;
  options.model = "ggx";
  CHECK_NOTHROW(sufficient_statistics(*a, options));
}

TEST_CASE("what does not belong together is refused") {
  FitOptions phong, blinn, cbrt;
  phong.model = "phong";
  phong.metric = blinn.metric = Metric::linear;
  cbrt.metric = Metric::cbrt;
  const auto with_u = data(1, {10}, true), without = data(1, {10}, false);
  const SufficientStatistics first = sufficient_statistics(*without, blinn);
  CHECK_NOTHROW(merge({first, first}));
  CHECK_THROWS_AS(merge({}), Error);
  CHECK_THROWS_AS(merge({first, sufficient_statistics(*without, phong)}), Error);
  CHECK_THROWS_AS(merge({first, sufficient_statistics(*without, cbrt)}), Error);
  CHECK_THROWS_AS(merge({first, sufficient_statistics(*with_u, blinn)}), Error);
  CHECK_THROWS_AS(fit(first, phong), Error);  // statistics over θh, a model of ψ
  CHECK_THROWS_AS(fit(first, cbrt), Error);   // another metric
  FitOptions log1p;
  log1p.metric = Metric::log1p;
  CHECK_THROWS_AS(sufficient_statistics(*without, log1p), Error);
  auto drifting = test::readings(test::lobe("phong", 0.2, 0.3, 40), test::polar_grid({10}, 5, 15), {}, 1);
  drifting->correlated = {{"drift", 0.1, std::vector(drifting->size(), 1.0)}};
  CHECK_THROWS_AS(sufficient_statistics(*observe(drifting), phong), Error);
}
