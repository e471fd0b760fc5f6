// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/angle_bins.hpp"

#include <cmath>
#include <random>

#include "fitting/fit.hpp"
#include "fitting/solution.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr unsigned seed = 20240611;

/// Noise of 1 % and 1e-4 1/sr on a grid of half and difference angles as MERL's, with `azimuths` of its 180.
std::shared_ptr<Dataset> table(const AnalyticBrdf& truth, int azimuths) {
  auto data = std::make_shared<Dataset>();
  data->channels = truth.channels();
  data->f.resize(truth.channels().size());
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int h = 0; h < 90; ++h)
    for (int d = 0; d < 90; ++d)
      for (int p = 0; p < azimuths; ++p) {
        const DirectionPair pair = directions(
            HalfDifference{degrees((h + 0.5) * (h + 0.5) / 90), degrees(0), degrees(d + 0.5), degrees((p + 0.5) * 180 / azimuths)});
        if (!(pair.wi.z() > 0) || !(pair.wo.z() > 0)) continue;
        data->angles.push_back(gonio_angles(pair.wi, pair.wo));
        const auto f = truth.eval(data->angles.back());
        for (std::size_t c = 0; c < f.size(); ++c) data->f[c].push_back(f[c] + std::hypot(0.01 * f[c], 1e-4) * normal(random));
      }
  return data;
}

/// Weights by the noise of the truth, a function of the angle of a row alone.
void weigh_by_truth(Terms& terms, const AnalyticBrdf& truth) {
  const std::vector<double>& values = truth.values().front();
  std::vector<double> columns(terms.kernel.linear * terms.rows());
  terms.basis(0, terms.rows(), values.data() + terms.kernel.linear, columns.data(), terms.rows());
  ChannelTerms& channel = terms.channel.front();
  for (std::size_t row = 0; row < terms.rows(); ++row) {
    const double f = values[0] * columns[row] + values[1] * columns[terms.rows() + row];
    channel.weight[row] = (terms.collapsed ? static_cast<double>(channel.row_count[row]) : 1) / (1e-4 * f * f + 1e-8);
  }
  terms.pure_error = true;
}

Solution solved(Terms& terms) {
  SolveOptions how;
  how.limits.assign(1, {std::vector<double>(2, NAN), {}, {}});
  how.nonlinear.assign(1, {NAN, NAN, NAN});
  how.alike = {true};
  how.threads = 2;
  return solve(terms, how, {});
}

}  // namespace

TEST_CASE("bins of psi move no parameter by more than a twentieth of its interval") {
  for (const double s : {1e2, 1e3, 1e4}) {
    INFO("s = " << s << ", seed " << seed);
    const AnalyticBrdf truth = test::lobe("phong", 0.2, 0.3, s);
    const auto observations = observe(table(truth, 60));
    const ModelKernel kernel = model_kernel("phong");
    auto binned = binned_terms(*observations, kernel, Metric::linear, false, Robust::none, 2);
    REQUIRE(binned);
    CHECK(binned->rows() <= angle_bins + 1);
    Terms exact = make_terms(*observations, kernel, Metric::linear, 2);
    CHECK(binned->n_observations == exact.n_observations);
    CHECK(binned->not_fitted == exact.not_fitted);
    weigh_by_truth(exact, truth);
    weigh_by_truth(*binned, truth);
    const Solution by_samples = solved(exact), by_bins = solved(*binned);
    const auto compare = [](const Estimate& expected, const Estimate& found) {
      REQUIRE(expected.kind == IntervalKind::interval);
      const double width = *expected.high - *expected.low;
      CHECK(std::abs(found.value - expected.value) < width / 20);
      CHECK(*found.high - *found.low == Approx(width).epsilon(0.02));
    };
    compare(by_samples.nonlinear_estimate[0], by_bins.nonlinear_estimate[0]);
    for (std::size_t k = 0; k < 2; ++k) compare(by_samples.linear_estimate[0][k], by_bins.linear_estimate[0][k]);
  }
}

TEST_CASE("the rows of bins keep every sum of the samples, whatever the number of threads") {
  const auto data = table(test::lobe("phong", 0.2, 0.3, 50), 12);
  const auto observations = observe(data);
  for (const char* model : {"phong", "blinn-phong"}) {
    const auto one = binned_terms(*observations, model_kernel(model), Metric::linear, false, Robust::automatic, 1);
    const auto two = binned_terms(*observations, model_kernel(model), Metric::linear, false, Robust::automatic, 2);
    REQUIRE(one);
    REQUIRE(two);
    const ChannelTerms& channel = one->channel.front();
    CHECK(channel.target == two->channel.front().target);
    CHECK(channel.row_within == two->channel.front().row_within);
    double count = 0, sum = 0, square = channel.within, expected_sum = 0, expected_square = 0;
    for (std::size_t row = 0; row < one->rows(); ++row) {
      count += channel.weight[row], sum += channel.weight[row] * channel.target[row];
      square += channel.weight[row] * channel.target[row] * channel.target[row];
    }
    for (const double f : data->f.front()) expected_sum += f, expected_square += f * f;
    constexpr double rounding_only = 1e-12;
    CHECK(count == static_cast<double>(data->angles.size()));
    CHECK(sum == Approx(expected_sum).epsilon(rounding_only));
    CHECK(square == Approx(expected_square).epsilon(rounding_only));
  }
}

TEST_CASE("samples are binned only where that loses nothing that was asked for") {
  const auto bins = [](const Dataset& data, const char* model, Metric metric) {
    return binned_terms(*observe(std::make_shared<Dataset>(data)), model_kernel(model), metric, false, Robust::none, 1).has_value();
  };
  const auto plain = table(test::lobe("phong", 0.2, 0.3, 50), 12);
  REQUIRE(plain->angles.size() >= fewest_binned);
  CHECK(bins(*plain, "phong", Metric::linear));
  CHECK(bins(*plain, "phong", Metric::log));
  CHECK_FALSE(bins(*plain, "phong", Metric::log1p));
  CHECK_FALSE(bins(*plain, "ggx", Metric::linear));
  CHECK_FALSE(bins(*plain, "lambert", Metric::linear));
  Dataset with_u = *plain, open = *plain, tilted = *plain, small = *plain;
  with_u.u = with_u.f;
  CHECK_FALSE(bins(with_u, "phong", Metric::linear));
  open.apertures.receiver_half_angle_deg = 0.5;
  CHECK_FALSE(bins(open, "phong", Metric::linear));
  tilted.correlated.push_back({"tilt", 0.1, {std::vector<double>(tilted.angles.size(), 0.1)}});
  CHECK_FALSE(bins(tilted, "phong", Metric::linear));
  small.angles.resize(fewest_binned - 1), small.f.front().resize(fewest_binned - 1);
  CHECK_FALSE(bins(small, "phong", Metric::linear));
}

TEST_CASE("clean bins keep every reading; single wrong ones are left out and listed, and the fit does not feel them") {
  const AnalyticBrdf truth("phong", rgb_channels(), {{0.2, 0.3, 2000}, {0.15, 0.3, 2000}, {0.1, 0.3, 2000}});
  auto data = table(truth, 30);
  FitOptions options;
  options.model = "phong";
  const FitResult clean = fit(*observe(data), options);
  INFO("seed " << seed);
  CHECK(clean.weighting.n_outliers == 0);
  CHECK(clean.weighting.source == WeightSource::rows);
  CHECK(clean.rows.of == RowsOf::psi_bins);
  CHECK(clean.rows.count <= angle_bins + 1);
  CHECK_FALSE(clean.rows.reason.empty());
  std::size_t spoilt = 0;
  for (std::size_t k = 37; k < data->angles.size(); k += 101, ++spoilt) data->f[1][k] *= 20;
  const FitResult found = fit(*observe(data), options);
  CHECK(found.weighting.n_outliers >= spoilt * 99 / 100);
  CHECK(found.weighting.n_outliers <= spoilt);
  REQUIRE_FALSE(found.weighting.outliers.empty());
  for (const Outlier& outlier : found.weighting.outliers) CHECK((outlier.channel == 1 && outlier.sample % 101 == 37));
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) CHECK(found.values[c][k] == Approx(truth.values()[c][k]).epsilon(k == 2 ? 0.003 : 0.01));
  for (const FittedParameter& p : clean.parameters) {
    INFO(p.name << " = " << p.value << " in [" << p.low.value_or(NAN) << ", " << p.high.value_or(NAN) << "]");
    const std::size_t place = p.name == "rho_d" ? 0 : p.name == "rho_s" ? 1 : 2;
    REQUIRE(p.sigma);
    CHECK(std::abs(p.value - truth.values()[p.channel.value_or(0)][place]) < 4 * *p.sigma);
  }
}
