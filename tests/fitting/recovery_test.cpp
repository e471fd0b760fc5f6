// SPDX-License-Identifier: BSD-3-Clause
// Exact samples give the parameters back, for every model and metric, over the whole range of exponents.
#include <cmath>
#include <limits>

#include "brdf/error.hpp"
#include "brdf/models.hpp"
#include "fitting/fit.hpp"
#include "fitting/polish.hpp"
#include "fitting/profile.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr Metric metrics[] = {Metric::linear, Metric::linear_cos, Metric::log, Metric::log1p, Metric::cbrt};

/// Retro-reflecting and mirror pairs, dense about the peak of a lobe with exponent s, and the hemisphere.
std::vector<GonioAngles> angles_for(double s) {
  std::vector<GonioAngles> out = polar_grid({5, 35, 65}, 10, 45);
  const double width = std::min(20.0, 57.3 / std::sqrt(std::max(s, 1.0)));
  for (double step = -4; step <= 4; step += 0.25) out.push_back({degrees(40), degrees(0), degrees(40 + step * width / 2), degrees(180)});
  return out;
}

/// Table order, the example of every parameter; linear ones apart, so that none can stand for another.
std::vector<double> parameters_of(const ModelInfo& info) {
  std::vector<double> values;
  for (std::size_t k = 0; k < info.parameters.size(); ++k)
    values.push_back(info.parameters[k].example * (k < info.linear_count ? 1 + 0.1 * static_cast<double>(k) : 1));
  return values;
}

}  // namespace

TEST_CASE("every model is recovered from exact samples under every metric") {
  for (const ModelInfo& info : model_infos())
    for (const Metric metric : metrics) {
      const AnalyticBrdf truth(info.name, single_channel("Y"), {parameters_of(info)});
      FitOptions options;
      options.model = info.name;
      options.metric = metric;
      // More than three are not determined by such data.
      for (std::size_t k = info.linear_count + 3; k < info.parameters.size(); ++k)
        options.fixed[std::string(info.parameters[k].name)] = truth.values()[0][k];
      const FitResult result = fit(*observe(readings(truth, angles_for(12), {}, 1)), options);
      INFO(info.name << ' ' << name(metric) << ' ' << result.reason);
      REQUIRE(result.status == Status::converged);
      for (std::size_t k = 0; k < truth.values()[0].size(); ++k) CHECK(result.values[0][k] == Approx(truth.values()[0][k]).epsilon(1e-6));
      CHECK(result.errors.linear < 1e-7);
      for (const FittedParameter& p : result.parameters)
        if (p.sigma) CHECK(*p.sigma > 0);
    }
}

TEST_CASE("exponents from 0.01 to a million are recovered") {
  for (const char* model : {"blinn-phong", "phong", "blinn-phong-exact"})
    for (double s = 1e-2; s < 2e6; s *= 10) {
      const AnalyticBrdf truth = lobe(model, .25, .4, s);
      FitOptions options;
      options.model = model;
      const FitResult result = fit(*observe(readings(truth, angles_for(s), {}, 1)), options);
      INFO(model << ' ' << s);
      CHECK(result.values[0][2] == Approx(s).epsilon(1e-5));
      CHECK(result.values[0][0] == Approx(.25).epsilon(1e-4));
      CHECK(result.values[0][1] == Approx(.4).epsilon(1e-4));
    }
}

TEST_CASE("residual derivatives agree with differences for every model and metric, at grazing, at the horizon and without a lobe") {
  std::vector<GonioAngles> angles = polar_grid({0, 40}, 20, 60);
  angles.push_back({degrees(40), degrees(0), degrees(40), degrees(180)});       // the peak
  angles.push_back({degrees(89.99), degrees(0), degrees(89.9), degrees(180)});  // grazing
  angles.push_back({degrees(90), degrees(0), degrees(90), degrees(0)});         // theta_h = 90°
  angles.push_back({degrees(90), degrees(0), degrees(90), degrees(180)});       // h = 0
  angles.push_back({degrees(80), degrees(0), degrees(80), degrees(0)});         // no mirror lobe
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->angles = angles;
  data->f = {std::vector<double>(angles.size(), 0.1)};
  const auto observations = observe(data);
  for (const ModelInfo& info : model_infos())
    for (const Metric metric : metrics)
      // Along the scan axes of the nonlinear parameters, all at the same part of theirs.
      for (const double part : {0.0, 0.3, 0.5, 0.7}) {
        const Terms terms = make_terms(*observations, model_kernel(info.name), metric, 1);
        const std::size_t rows = terms.rows(), linear = terms.kernel.linear, nonlinear = terms.kernel.nonlinear;
        std::vector<double> theta;
        for (std::size_t j = 0; j < nonlinear; ++j) {
          const Parameter& p = info.parameters[linear + j];
          theta.push_back(p.axis == Parameter::Axis::logarithmic ? p.scan_low * std::pow(p.scan_high / p.scan_low, part)
                                                                 : p.scan_low + (p.scan_high - p.scan_low) * (0.05 + part));
        }
        std::vector<double> x(linear, 0.3), out(rows), by_x(rows * linear), by_theta(rows * nonlinear), low(rows), high(rows);
        INFO(info.name << ' ' << name(metric) << " at " << part << " of the axes");
        REQUIRE(residuals(terms, 0, 0, rows, x.data(), theta.data(), out.data(), by_x.data(), by_theta.data()));
        const double step = 1e-5;
        for (std::size_t k = 0; k < linear + nonlinear; ++k) {
          std::vector<double> below = x, above = x, theta_below = theta, theta_above = theta;
          double width = 2 * step;
          if (k < linear)
            below[k] -= step, above[k] += step;
          else {
            const double at = theta[k - linear], move = step * std::abs(at);
            theta_below[k - linear] = at - move, theta_above[k - linear] = at + move;
            width = theta_above[k - linear] - theta_below[k - linear];
          }
          REQUIRE(residuals(terms, 0, 0, rows, below.data(), theta_below.data(), low.data(), nullptr, nullptr));
          REQUIRE(residuals(terms, 0, 0, rows, above.data(), theta_above.data(), high.data(), nullptr, nullptr));
          for (std::size_t row = 0; row < rows; ++row) {
            const double derivative = k < linear ? by_x[row * linear + k] : by_theta[row * nonlinear + k - linear];
            const double scale = 1e-10 * (1 + std::abs(out[row])) / width;  // rounding of the difference
            INFO("parameter " << info.parameters[k].name << ", row " << row);
            CHECK(std::isfinite(derivative));
            CHECK(derivative == Approx((high[row] - low[row]) / width).epsilon(1e-4).margin(1e-7 + scale));
          }
        }
      }
}

TEST_CASE("a truth of two lobes reports both minima under relative weights") {
  const std::vector<GonioAngles> angles = [] {
    std::vector<GonioAngles> out;
    for (double theta_h = 0; theta_h <= 80; theta_h += 0.25) out.push_back({degrees(theta_h), degrees(0), degrees(theta_h), degrees(0)});
    return out;
  }();
  const AnalyticBrdf broad = lobe("blinn-phong", .1, .2, 10), narrow = lobe("blinn-phong", 0, .2, 5000);
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->angles = angles;
  data->f.resize(1), data->u.resize(1);
  for (const GonioAngles& a : angles) {
    data->f[0].push_back(broad.eval(a)[0] + narrow.eval(a)[0]);
    data->u[0].push_back(0.01 * data->f[0].back());
  }
  const FitResult result = fit(*observe(data), {});
  REQUIRE(result.other_minima.size() == 1);
  const double a = result.values[0][2], b = result.other_minima[0].nonlinear[0];
  INFO(a << ' ' << b);
  CHECK(std::min(a, b) < 100);
  CHECK(std::max(a, b) > 1000);
  CHECK(result.other_minima[0].cost_ratio > 1);
  const auto adequacy = std::find_if(result.checks.begin(), result.checks.end(), [](const Check& c) { return c.id == "adequacy"; });
  REQUIRE(adequacy != result.checks.end());
  CHECK(adequacy->verdict == Verdict::fail);
}

TEST_CASE("NaN and infinite values, readings below the horizon and f <= 0 under log are left out and counted") {
  const AnalyticBrdf truth = lobe("phong", .25, .4, 12);
  auto data = readings(truth, angles_for(12), {}, 1);
  const std::size_t clean = data->size();
  const auto add = [&](double theta_o, double f) {
    data->angles.push_back({degrees(10), degrees(0), degrees(theta_o), degrees(0)});
    data->f[0].push_back(f);
  };
  add(20, std::nan(""));
  add(20, std::numeric_limits<double>::infinity());
  add(120, .3);
  FitOptions options;
  options.model = "phong";
  const FitResult linear = fit(*observe(data), options);
  CHECK(linear.n_observations == clean);
  CHECK(linear.not_fitted.total() == 3);
  CHECK(linear.values[0][2] == Approx(12).epsilon(1e-6));
  add(30, 0);
  add(30, -1);
  options.metric = Metric::log;
  const FitResult log = fit(*observe(data), options);
  CHECK(log.n_observations == clean);
  CHECK(log.not_fitted.total() == 5);
  CHECK(log.values[0][2] == Approx(12).epsilon(1e-6));
}

TEST_CASE("a few unknown uncertainties leave their samples out, mostly unknown ones leave the weights out") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({10, 40}, 10, 45), {1e-3, 0, 0}, 4);
  for (std::size_t k = 0; k < 5; ++k) data->u[0][k] = std::nan("");
  const FitResult few = fit(*observe(data), {});
  CHECK(few.not_fitted.total() == 5);
  CHECK(few.errors.chi2_per_dof);
  for (std::size_t k = 0; k + 10 < data->size(); ++k) data->u[0][k] = std::nan("");
  const FitResult most = fit(*observe(data), {});
  CHECK(most.not_fitted.total() == 0);
  CHECK(!most.errors.chi2_per_dof);
}

TEST_CASE("nothing usable is a status, not an exception") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->f.resize(1);
  CHECK(fit(*observe(data), {}).status == Status::no_usable_data);
  data->angles.assign(3, {degrees(10), degrees(0), degrees(20), degrees(0)});
  data->f[0].assign(3, std::nan(""));
  const FitResult result = fit(*observe(data), {});
  CHECK(result.status == Status::no_usable_data);
  CHECK(result.not_fitted.total() == 3);
  CHECK(!result.reason.empty());
}

TEST_CASE("all-zero and all-negative data converge to a black surface under the linear metric") {
  for (const double value : {0.0, -0.1}) {
    auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({10, 40}, 10, 45), {}, 4);
    for (double& f : data->f[0]) f = value;
    const FitResult result = fit(*observe(data), {});
    CHECK(result.status == Status::converged);
    CHECK(result.values[0][0] == 0);
    CHECK(result.values[0][1] == 0);
  }
}

TEST_CASE("channels share the exponent unless told otherwise") {
  const AnalyticBrdf truth("blinn-phong", rgb_channels(), {{.2, .3, 10}, {.1, .2, 40}, {.3, .1, 160}});
  const auto observations = observe(readings(truth, angles_for(40), {}, 1));
  const FitResult shared = fit(*observations, {});
  CHECK(shared.parameters.size() == 7);
  CHECK(shared.values[0][2] == shared.values[2][2]);
  FitOptions options;
  options.per_channel = true;
  const FitResult own = fit(*observations, options);
  CHECK(own.parameters.size() == 9);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) CHECK(own.values[c][k] == Approx(truth.values()[c][k]).epsilon(1e-6));
}

TEST_CASE("a solver that is stopped early hands back its start and says so") {
  const Terms terms =
      make_terms(*observe(readings(lobe("phong", .25, .4, 12), angles_for(12), {}, 1)), model_kernel("phong"), Metric::log, 1);
  const double free = std::numeric_limits<double>::quiet_NaN();
  const std::vector<LinearLimits> limits{{{free, free}, {}, {}}};
  const SearchSpace space(terms.kernel, {{free, free, free}}, {true});
  const Polished stopped = polish(terms, space, limits, {{.5, .1}}, {40}, 1, 1);
  CHECK(!stopped.converged);
  CHECK(!stopped.reason.empty());
  CHECK(stopped.theta.front() == 40);
  // ln 0 does not exist: the very first evaluation fails, and that is a result too.
  const Polished broken = polish(terms, space, limits, {{0, 0}}, {40}, 1);
  CHECK(!broken.converged);
  const Polished fine = polish(terms, space, limits, {{.5, .1}}, {40}, 1);
  CHECK(fine.converged);
  CHECK(fine.theta.front() == Approx(12).epsilon(1e-6));
}

TEST_CASE("an unknown model is an error of usage") {
  FitOptions options;
  options.model = "plastic";
  CHECK_THROWS_AS(fit(*observe(readings(lobe("phong", .25, .4, 12), polar_grid({10}, 20, 90), {}, 1)), options), Error);
}
