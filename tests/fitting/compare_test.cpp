// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/compare.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;

const MetricError& metric(const Comparison& comparison, const std::string& name, std::optional<std::size_t> channel = {}) {
  return *std::find_if(comparison.metrics.begin(), comparison.metrics.end(),
                       [&](const MetricError& error) { return error.metric == name && error.channel == channel; });
}

/// Two values per channel at two directions, nothing else.
ComparedValues two_directions() {
  ComparedValues out;
  out.at = ComparedAt::samples_of_a;
  out.channels = {{"Y", 0, 0}};
  out.angles = {{60_deg, 0_deg, 30_deg, 180_deg}, {0_deg, 0_deg, 85_deg, 0_deg}};
  out.weight = {1, 1};
  out.a.f = {{1.0, 2.0}};
  out.b.f = {{1.5, 2.0}};
  return out;
}

}  // namespace

TEST_CASE("Every metric is the root mean square of its own residual") {
  const Comparison comparison = compare(two_directions());
  CHECK(comparison.n == 2);
  const auto half = [](double residual) { return residual / std::sqrt(2.0); };
  CHECK(std::fabs(*metric(comparison, "linear").absolute - half(.5)) < rounding);
  CHECK(std::fabs(*metric(comparison, "linear").relative - .5 / std::sqrt(5.0)) < rounding);
  CHECK(std::fabs(*metric(comparison, "linear-cos").absolute - half(.25)) < rounding);
  CHECK(std::fabs(*metric(comparison, "log").absolute - half(std::log(1.5))) < rounding);
  CHECK_FALSE(metric(comparison, "log").relative);
  CHECK(std::fabs(*metric(comparison, "log1p").absolute - half(std::log(1.75 / 1.5))) < rounding);
  CHECK(std::fabs(*metric(comparison, "cbrt").absolute - half(std::cbrt(1.5) - 1)) < rounding);
  // The second direction lies beyond 80° and has no solid angle at theta_i = 0.
  CHECK(metric(comparison, "ngan").n == 1);
  CHECK(std::fabs(*metric(comparison, "ngan").absolute - .25) < rounding);
  CHECK(std::fabs(*metric(comparison, "ngan").relative - .5) < rounding);
}

TEST_CASE("The largest differences and the incidences name their place") {
  const Comparison comparison = compare(two_directions());
  REQUIRE(comparison.largest_absolute);
  CHECK(comparison.largest_absolute->difference == .5);
  CHECK(comparison.largest_absolute->angles.theta_i.degrees() == 60);
  CHECK(std::fabs(comparison.largest_relative->difference - .4) < rounding);
  REQUIRE(comparison.incidences.size() == 2);
  CHECK(comparison.incidences[0].theta_i_deg == 0);
  CHECK(comparison.incidences[0].absolute == 0);
  CHECK(std::fabs(*comparison.incidences[1].bias - .5) < rounding);
  CHECK_FALSE(comparison.chi_square);
}

TEST_CASE("What one side does not know, and what has no logarithm, is left out and counted") {
  ComparedValues values = two_directions();
  values.a.f[0][0] = std::nan("");
  values.b.f[0][1] = -1;
  const Comparison comparison = compare(values);
  CHECK(comparison.n == 1);
  CHECK(comparison.n_unknown == 1);
  CHECK(comparison.n_not_positive == 1);
  CHECK_FALSE(metric(comparison, "log").absolute);
}

TEST_CASE("Ngan's metric of two Lambertian BRDFs has its closed form") {
  const AnalyticBrdf a("lambert", rgb_channels(), {{.5}, {.5}, {.5}}), b("lambert", rgb_channels(), {{.4}, {.4}, {.4}});
  const Comparison comparison =
      compare(compared_values({std::make_shared<AnalyticBrdf>(a), nullptr}, {std::make_shared<AnalyticBrdf>(b), nullptr}, 80_deg));
  // Mean of cos² over solid angle up to 80°: (1 - c³) / (3 (1 - c)).
  const double c = std::cos(80 * pi / 180), mean = (1 - c * c * c) / (3 * (1 - c));
  constexpr double quadrature = 2e-3;
  CHECK(std::fabs(*metric(comparison, "ngan").absolute / (.1 / pi * std::sqrt(mean)) - 1) < quadrature);
  CHECK(std::fabs(*metric(comparison, "ngan").relative - .2) < rounding);
  CHECK(metric(comparison, "ngan", 2).relative);
  CHECK(std::fabs(*metric(comparison, "linear").relative - .2) < rounding);
}

TEST_CASE("chi² of readings of the same BRDF is about 1; a common scale is not counted once per sample") {
  const AnalyticBrdf truth = test::lobe("phong", .3, .2, 20);
  const auto grid = test::polar_grid({10, 40, 70}, 5, 15);
  const auto a = test::readings(truth, grid, {.relative = .01}, 1), b = test::readings(truth, grid, {.relative = .02}, 2);
  const auto chi_square = [&] { return *compare(compared_values({nullptr, a}, {nullptr, b}, 80_deg)).chi_square; };
  ChiSquare chi = chi_square();
  CHECK(chi.n == grid.size());
  CHECK(chi.uncertainty_of == "both");
  const double spread = 4 * std::sqrt(2.0 / static_cast<double>(chi.n));  // four standard deviations of chi²/n
  INFO(chi.independent_per_n);
  CHECK(std::fabs(chi.independent_per_n - 1) < spread);
  CHECK(chi.independent_per_n == chi.correlated_per_n);

  for (double& f : b->f[0]) f *= 1.03;  // the wrong case: a scale that nobody stated
  chi = chi_square();
  CHECK(chi.independent_per_n > 1 + 2 * spread);
  CHECK(chi.p_value < 1e-6);
  b->correlated = {{"scale", .03, {}}};  // stated
  chi = chi_square();
  CHECK(chi.independent_per_n > 1 + 2 * spread);
  CHECK(std::fabs(chi.correlated_per_n - 1) < spread);
  CHECK(chi.p_value > 1e-3);
}

TEST_CASE("Samples against a model use the samples' uncertainties; interpolated samples have none to use") {
  const AnalyticBrdf truth = test::lobe("phong", .3, .2, 20);
  const auto data = test::readings(truth, test::polar_grid({10, 40}, 5, 15), {.relative = .01}, 3);
  const CompareSubject model{std::make_shared<AnalyticBrdf>(truth), nullptr}, measured{nullptr, data};
  const auto chi = compare(compared_values(model, measured, 80_deg)).chi_square;
  REQUIRE(chi);
  CHECK(chi->uncertainty_of == "b");
  const auto elsewhere = test::readings(truth, test::polar_grid({11, 41}, 5, 15), {.relative = .01}, 4);
  CHECK_FALSE(compare(compared_values(measured, {std::make_shared<AnalyticBrdf>(truth), elsewhere}, 80_deg)).chi_square);
}
