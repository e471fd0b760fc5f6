// SPDX-License-Identifier: BSD-3-Clause
// Intervals hold the truth as often as they say, and say what the data cannot.
#include <array>
#include <cmath>

#include "fitting/fit.hpp"
#include "tests/fitting/fitted_parameter.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

bool holds(const FittedParameter& p, double truth, double shrink = 1) {
  const double low = p.low ? p.value - shrink * (p.value - *p.low) : -INFINITY,
               high = p.high ? p.value + shrink * (*p.high - p.value) : INFINITY;
  return truth >= low && truth <= high;
}

struct Coverage {
  std::array<int, 3> full{}, halved{};
};

constexpr double normal_quantile = 1.959964;
constexpr int draws = 400;
// A coverage of 95 % gives fewer than 364 or more than 393 hits of 400 with a probability below 1 %.
constexpr int fewest = 364, most = 393;

/// With the common scale in squares, which multiplies the linear parameters alone.
FittedParameter with_scale(FittedParameter p, double u_scale) {
  const double extra = normal_quantile * u_scale * p.value;
  if (p.low) p.low = p.value - std::hypot(p.value - *p.low, extra);
  if (p.high) p.high = p.value + std::hypot(*p.high - p.value, extra);
  return p;
}

/// `narrow`: intervals without the common scale.
Coverage coverage(const AnalyticBrdf& truth, Metric metric, const Noise& noise, double scale_u, bool narrow = false) {
  const std::array<const char*, 3> names{"rho_d", "rho_s", "s"};
  const std::vector<GonioAngles> angles = polar_grid({0, 20, 40, 60}, 10, 30);
  Coverage out;
  std::mt19937_64 random(20260701);
  std::normal_distribution<double> normal;
  for (unsigned seed = 0; seed < draws; ++seed) {
    auto data = readings(truth, angles, noise, seed + 1);
    if (scale_u > 0) {
      const double scale = 1 + scale_u * normal(random);
      for (double& f : data->f[0]) f *= scale;
      data->correlated.push_back({"scale", scale_u, {}});
    }
    FitOptions options;
    options.model = truth.model().name;
    options.metric = metric;
    options.threads = 1;
    const FitResult result = fit(*observe(data), options);
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool linear = k < 2 && !narrow;
      const FittedParameter p = with_scale(parameter(result, names[k]), linear ? result.u_scale.value_or(0) : 0);
      out.full[k] += holds(p, truth.values()[0][k]);
      out.halved[k] += holds(p, truth.values()[0][k], 0.5);
    }
  }
  return out;
}

void require_coverage(const Coverage& found) {
  for (std::size_t k = 0; k < found.full.size(); ++k) {
    INFO("parameter " << k << ": " << found.full[k] << " of " << draws);
    CHECK(found.full[k] >= fewest);
    CHECK(found.full[k] <= most);
    // The gate itself: intervals of half the width must not get through.
    CHECK(found.halved[k] < fewest);
  }
}

}  // namespace

TEST_CASE("95 % intervals hold the truth in 95 % of sweeps with shot and read noise") {
  require_coverage(coverage(lobe("blinn-phong", .2, .3, 20), Metric::linear, {1e-3, 1e-4, 0}, 0));
}
TEST_CASE("95 % intervals hold the truth for a mirror lobe without any stated uncertainty") {
  const AnalyticBrdf truth = lobe("phong", .4, .2, 8);
  const std::vector<GonioAngles> angles = polar_grid({10, 50}, 10, 30);
  Coverage found;
  for (unsigned seed = 0; seed < draws; ++seed) {
    auto data = readings(truth, angles, {2e-3, 0, 0}, seed + 1);
    data->u.clear();
    FitOptions options;
    options.model = "phong";
    options.threads = 1;
    const FitResult result = fit(*observe(data), options);
    const std::array<const char*, 3> names{"rho_d", "rho_s", "s"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      found.full[k] += holds(parameter(result, names[k]), truth.values()[0][k]);
      found.halved[k] += holds(parameter(result, names[k]), truth.values()[0][k], 0.5);
    }
  }
  require_coverage(found);
}
TEST_CASE("95 % intervals hold the truth under the log metric") {
  require_coverage(coverage(lobe("blinn-phong", .3, .2, 30), Metric::log, {0, 0, 0.02}, 0));
}
TEST_CASE("a common scale, added in squares, completes the intervals of the albedos and leaves the exponent alone") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 20);
  require_coverage(coverage(truth, Metric::linear, {1e-3, 1e-4, 0}, 0.02));
  // Without it the albedos are not covered, so that it is in no interval already; the exponent is.
  const Coverage narrow = coverage(truth, Metric::linear, {1e-3, 1e-4, 0}, 0.02, true);
  CHECK(narrow.full[0] < fewest);
  CHECK(narrow.full[1] < fewest);
  CHECK(narrow.full[2] >= fewest);
}

TEST_CASE("a lobe that only the peak sample sees has a lower bound on its exponent") {
  // theta_h in steps of 5°: s = 1e5 falls to nothing before the first neighbour (s D² = 760).
  std::vector<GonioAngles> angles;
  for (double theta = 0; theta <= 80; theta += 5) angles.push_back({degrees(theta), degrees(0), degrees(theta), degrees(0)});
  const FitResult result = fit(*observe(readings(lobe("blinn-phong", .2, .3, 1e5), angles, {1e-4, 0, .01}, 7)), {});
  const FittedParameter& s = parameter(result, "s");
  CHECK(s.kind == IntervalKind::lower_bound);
  REQUIRE(s.low);
  CHECK(*s.low < 1e5);
  CHECK(!s.high);
  CHECK(!s.sigma);
}

TEST_CASE("without a lobe the exponent is unidentified and has no sigma") {
  const FitResult result = fit(*observe(readings(lobe("blinn-phong", .4, 0, 10), polar_grid({10, 40}, 10, 45), {1e-3, 0, 0}, 3)), {});
  const FittedParameter& s = parameter(result, "s");
  CHECK(s.kind == IntervalKind::unidentified);
  CHECK(!s.sigma);
  CHECK(!s.low);
  CHECK(!s.high);
  CHECK(parameter(result, "rho_s").kind != IntervalKind::interval);
  CHECK(!parameter(result, "rho_s").sigma);
}

TEST_CASE("the exponent of a second lobe that is not there has no end beyond its search, without noise either") {
  const AnalyticBrdf truth("ggx", single_channel("value"), {{.2, .04, 1, .2}});
  auto data = std::make_shared<Dataset>();
  data->channels = truth.channels();
  for (int theta_i = 0; theta_i < 80; theta_i += 10)
    for (int theta_o = 0; theta_o < 85; theta_o += 3)
      for (int phi_o = 0; phi_o <= 360; phi_o += 15)
        data->angles.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi_o)});
  data->f.resize(1);
  for (const GonioAngles& angles : data->angles) data->f[0].push_back(truth.eval(angles.wi(), angles.wo())[0]);
  FitOptions options;
  options.model = "ggx+phong";
  const FitResult result = fit(*observe(data), options);
  REQUIRE(result.status == Status::converged);
  CHECK(parameter(result, "alpha").value == Approx(.2).epsilon(1e-6));
  for (const FittedParameter& p : result.parameters) {
    INFO(p.name);
    if (p.high) CHECK(std::isfinite(*p.high));
    if (p.low) CHECK(std::isfinite(*p.low));
  }
  CHECK(parameter(result, "s").kind != IntervalKind::interval);
  CHECK_FALSE(parameter(result, "s").sigma);
}

TEST_CASE("as many samples as parameters determine nothing without a stated uncertainty") {
  const std::vector<GonioAngles> angles{{degrees(0), degrees(0), degrees(0), degrees(0)},
                                        {degrees(30), degrees(0), degrees(30), degrees(0)},
                                        {degrees(60), degrees(0), degrees(60), degrees(0)}};
  const FitResult result = fit(*observe(readings(lobe("blinn-phong", .2, .3, 10), angles, {}, 1)), {});
  for (const FittedParameter& p : result.parameters) {
    CHECK(p.kind == IntervalKind::unidentified);
    CHECK(!p.sigma);
  }
}

TEST_CASE("a single sample leaves every parameter without a sigma") {
  const std::vector<GonioAngles> angles{{degrees(30), degrees(0), degrees(30), degrees(180)}};
  const FitResult result = fit(*observe(readings(lobe("blinn-phong", .2, .3, 10), angles, {1e-3, 0, 0}, 1)), {});
  for (const FittedParameter& p : result.parameters) CHECK(!p.sigma);
}

TEST_CASE("a sigma agrees with the width of its interval where the problem is nearly linear") {
  const FitResult result =
      fit(*observe(readings(lobe("blinn-phong", .2, .3, 20), polar_grid({0, 20, 40, 60}, 5, 15), {1e-3, 1e-4, 0}, 3)), {});
  for (const FittedParameter& p : result.parameters) {
    INFO(p.name);
    REQUIRE(p.sigma);
    CHECK((*p.high - *p.low) / 2 == Approx(1.959964 * *p.sigma).epsilon(0.02));
  }
}

TEST_CASE("a fixed parameter stays where it is and is said to be fixed") {
  FitOptions options;
  options.fixed["s"] = 12;
  const FitResult result = fit(*observe(readings(lobe("blinn-phong", .2, .3, 12), polar_grid({10, 40}, 10, 45), {}, 1)), options);
  CHECK(parameter(result, "s").kind == IntervalKind::fixed);
  CHECK(parameter(result, "s").value == 12);
  CHECK(parameter(result, "rho_d").value == Approx(.2).epsilon(1e-10));
  CHECK(parameter(result, "rho_s").value == Approx(.3).epsilon(1e-10));
  options.fixed = {{"rho_d", .2}};
  const FitResult other = fit(*observe(readings(lobe("blinn-phong", .2, .3, 12), polar_grid({10, 40}, 10, 45), {}, 1)), options);
  CHECK(parameter(other, "rho_d").value == .2);
  CHECK(parameter(other, "s").value == Approx(12).epsilon(1e-6));
  options.fixed = {{"rho_x", .2}};
  CHECK_THROWS(fit(*observe(readings(lobe("blinn-phong", .2, .3, 12), polar_grid({10}, 10, 45), {}, 1)), options));
}
