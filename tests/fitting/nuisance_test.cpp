// SPDX-License-Identifier: BSD-3-Clause
// A tilt, a turned surface and a range that is off are estimated beside the model, with what they do to its intervals.
#include "fitting/nuisance.hpp"

#include <cmath>
#include <numbers>

#include "brdf/error.hpp"
#include "fitting/corrected.hpp"
#include "tests/fitting/fitted_parameter.hpp"
#include "tests/fitting/ngan_grid.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

const NuisanceParameter& nuisance(const FitResult& result, const std::string& name) {
  for (const NuisanceParameter& p : result.nuisance)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

std::vector<GonioAngles> seen_by_all(const std::vector<GonioAngles>& angles, const Misalignment& m) {
  std::vector<GonioAngles> out;
  for (const GonioAngles& a : angles) out.push_back(seen_by(m, a));
  return out;
}

/// What a misaligned sample gives at the stated angles.
std::shared_ptr<Dataset> misaligned(const AnalyticBrdf& truth, const std::vector<GonioAngles>& angles, const Misalignment& m,
                                    const Noise& noise, unsigned seed) {
  auto data = readings(truth, seen_by_all(angles, m), noise, seed);
  data->angles = angles;
  return data;
}

FitOptions asking(const std::string& model, NuisanceOptions what) {
  FitOptions options;
  options.model = model;
  options.nuisance = what;
  options.threads = 1;
  return options;
}

constexpr NuisanceOptions tilt{true, false, false}, tilt_and_azimuth{true, true, false}, azimuth{false, true, false},
    components{false, false, true};

/// 95 % of `draws` hold, within bounds that a true 95 % leaves with a probability below 1 %.
struct Counted {
  int held = 0, draws = 0;
  void add(double value, double low, double high) { held += low <= value && value <= high, ++draws; }
  double part() const { return static_cast<double>(held) / draws; }
};

}  // namespace

TEST_CASE("a tilt of half a degree spoils the exponent of a plain fit, and not of one that estimates it") {
  const AnalyticBrdf truth = ngan_material(2000);
  const Misalignment m{.5 * degree, -.3 * degree, 0};
  auto data = NoisyReadings(truth, seen_by_all(gantry_grid(), m)).draw(20261);
  data->angles = gantry_grid();
  FitOptions plain = asking("blinn-phong-ngan", {});
  const FitResult wrong = fit(*observe(data), plain);
  CHECK(std::abs(parameter(wrong, "s").value / 2000 - 1) > .1);
  const FitResult right = fit(*observe(data), asking("blinn-phong-ngan", tilt));
  REQUIRE(right.status == Status::converged);
  const FittedParameter& s = parameter(right, "s");
  INFO("s " << s.value << " ± " << s.sigma.value_or(0));
  REQUIRE(s.sigma);
  CHECK(std::abs(s.value - 2000) < 4 * *s.sigma);
  CHECK(std::abs(s.value / 2000 - 1) < .01);
  for (const auto& [name, expected] : {std::pair{"tilt_x", .5}, {"tilt_y", -.3}}) {
    const NuisanceParameter& t = nuisance(right, name);
    REQUIRE(t.sigma);
    INFO(name << " " << t.value << " ± " << *t.sigma);
    CHECK(std::abs(t.value - expected) < 4 * *t.sigma);
    CHECK(*t.sigma < .01);
    CHECK(t.unit == "deg");
    CHECK(!t.prior);
  }
  CHECK(right.likelihood.free_parameters == wrong.likelihood.free_parameters + 2);
  CHECK(right.likelihood.bic() < wrong.likelihood.bic());
  CHECK(right.errors.linear < .5 * wrong.errors.linear);
}

TEST_CASE("the sigma of a tilt is right, and intervals of the model cover beside it") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 200);
  const std::vector<GonioAngles> angles = polar_grid({0, 20, 40, 60}, 8, 24);
  const Misalignment m{.4 * degree, .2 * degree, 0};
  constexpr int draws = 200;
  double x2 = 0, y2 = 0;
  Counted rho_d, rho_s, s, blind;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const auto data = misaligned(truth, angles, m, {2e-3, 1e-4, 0}, seed);
    const FitResult result = fit(*observe(data), asking("blinn-phong", tilt));
    REQUIRE(result.status == Status::converged);
    const NuisanceParameter &x = nuisance(result, "tilt_x"), &y = nuisance(result, "tilt_y");
    REQUIRE(x.sigma);
    REQUIRE(y.sigma);
    x2 += std::pow((x.value - .4) / *x.sigma, 2), y2 += std::pow((y.value - .2) / *y.sigma, 2);
    const auto add = [&](Counted& to, const char* name, double value) {
      const FittedParameter& p = parameter(result, name);
      to.add(value, p.low.value_or(-INFINITY), p.high.value_or(INFINITY));
    };
    add(rho_d, "rho_d", .2), add(rho_s, "rho_s", .3), add(s, "s", 200);
    if (seed > draws / 4) continue;
    const FittedParameter p = parameter(fit(*observe(data), asking("blinn-phong", {})), "s");
    blind.add(200, p.low.value_or(-INFINITY), p.high.value_or(INFINITY));
  }
  INFO("rms z of tilt_x " << std::sqrt(x2 / draws) << ", tilt_y " << std::sqrt(y2 / draws));
  CHECK(std::sqrt(x2 / draws) == Approx(1).margin(.15));
  CHECK(std::sqrt(y2 / draws) == Approx(1).margin(.15));
  for (const Counted* counted : {&rho_d, &rho_s, &s}) {
    INFO("covered " << counted->held << " of " << counted->draws);
    CHECK(counted->part() >= .91);
    CHECK(counted->part() <= .985);
  }
  // The gate: without the tilt the exponent is not covered.
  CHECK(blind.part() < .5);
}

TEST_CASE("the orientation of a brushed surface is found") {
  const AnalyticBrdf truth("ward-anisotropic", single_channel("Y"), {{.2, .3, .1, .25}});
  std::vector<GonioAngles> angles;
  for (const double phi_i : {0., 45., 90.})
    for (const GonioAngles& a : polar_grid({15, 45}, 10, 30, phi_i)) angles.push_back(a);
  const auto data = misaligned(truth, angles, {0, 0, 7 * degree}, {1e-3, 1e-4, 0}, 5);
  const FitResult wrong = fit(*observe(data), asking("ward-anisotropic", {}));
  const FitResult right = fit(*observe(data), asking("ward-anisotropic", azimuth));
  const NuisanceParameter& turned = nuisance(right, "azimuth");
  REQUIRE(turned.sigma);
  INFO("azimuth " << turned.value << " ± " << *turned.sigma);
  CHECK(std::abs(turned.value - 7) < 4 * *turned.sigma);
  CHECK(*turned.sigma < .5);
  CHECK(*right.errors.chi2_per_dof == Approx(1).margin(.3));
  CHECK(*wrong.errors.chi2_per_dof > 2);
}

TEST_CASE("a diffuse surface determines neither tilt nor azimuth, and says so without a sigma") {
  const AnalyticBrdf truth("lambert", single_channel("Y"), {{.5}});
  const auto data = readings(truth, polar_grid({0, 30, 60}, 10, 30), {1e-3, 1e-4, 0}, 2);
  const FitResult plain = fit(*observe(data), asking("lambert", {}));
  const FitResult result = fit(*observe(data), asking("lambert", tilt_and_azimuth));
  REQUIRE(result.status == Status::converged);
  REQUIRE(result.nuisance.size() == 3);
  for (const NuisanceParameter& p : result.nuisance) {
    CHECK(p.kind == IntervalKind::unidentified);
    CHECK(p.value == 0);
    CHECK(!p.sigma);
    CHECK(!p.low);
  }
  CHECK(parameter(result, "rho_d").value == parameter(plain, "rho_d").value);
  CHECK(*parameter(result, "rho_d").sigma == Approx(*parameter(plain, "rho_d").sigma).epsilon(1e-9));
  CHECK(result.likelihood.free_parameters == plain.likelihood.free_parameters);
}

TEST_CASE("a sweep in one plane determines the tilt in it, not the one across, and an isotropic lobe no azimuth") {
  std::vector<GonioAngles> angles;
  for (const double theta_i : {10., 30., 50.})
    for (double theta_o = 0; theta_o <= 80; theta_o += 2) angles.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(180)});
  const auto data = misaligned(lobe("blinn-phong", .2, .3, 200), angles, {.4 * degree, 0, 0}, {1e-3, 1e-4, 0}, 2);
  const FitResult result = fit(*observe(data), asking("blinn-phong", tilt_and_azimuth));
  REQUIRE(nuisance(result, "tilt_x").sigma);
  CHECK(std::abs(nuisance(result, "tilt_x").value - .4) < 4 * *nuisance(result, "tilt_x").sigma);
  for (const char* name : {"tilt_y", "azimuth"}) {
    CHECK(nuisance(result, name).kind == IntervalKind::unidentified);
    CHECK(!nuisance(result, name).sigma);
    CHECK(nuisance(result, name).value == 0);
  }
}

TEST_CASE("a range ratio that is off is estimated, and intervals cover what it was drawn from") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 50);
  const std::vector<GonioAngles> angles = polar_grid({0, 20, 40, 60}, 8, 24);
  constexpr int draws = 100;
  constexpr double u = .05;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  double z2 = 0;
  Counted rho_d, rho_s, s;
  double sigma = 0, blind_sigma = 0;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    auto data = readings(truth, angles, {2e-3, 1e-4, 0}, seed);
    const double off = u * normal(random);
    CorrelatedComponent range{"range_ratio", u, std::vector<double>(data->size(), 0.0)};
    // The range is that of the true value: one chosen by the reading's own noise would select high readings.
    for (std::size_t k = 0; k < data->size(); ++k)
      if (truth.eval(angles[k])[0] > .12) range.sensitivity[k] = 1, data->f[0][k] *= 1 + off, data->u[0][k] *= 1 + off;
    data->correlated = {range};
    const FitResult result = fit(*observe(data), asking("blinn-phong", components));
    REQUIRE(result.nuisance.size() == 1);
    const NuisanceParameter& found = result.nuisance.front();
    REQUIRE(found.sigma);
    CHECK(found.prior == u);
    CHECK(*found.sigma < .7 * u);
    z2 += std::pow((found.value - std::log1p(off)) / *found.sigma, 2);
    const auto add = [&](Counted& to, const char* name, double value) {
      const FittedParameter& p = parameter(result, name);
      to.add(value, p.low.value_or(-INFINITY), p.high.value_or(INFINITY));
    };
    add(rho_d, "rho_d", .2), add(rho_s, "rho_s", .3), add(s, "s", 50);
    if (seed > 1) continue;
    sigma = *parameter(result, "s").sigma;
    blind_sigma = *parameter(fit(*observe(data), asking("blinn-phong", {})), "s").sigma;
  }
  INFO("rms z " << std::sqrt(z2 / draws));
  CHECK(std::sqrt(z2 / draws) == Approx(1).margin(.2));
  for (const Counted* counted : {&rho_d, &rho_s, &s}) {
    INFO("covered " << counted->held << " of " << counted->draws);
    CHECK(counted->part() >= .88);
  }
  // What the data say about the ratio makes the exponent surer than the statement alone.
  CHECK(sigma < .8 * blind_sigma);
}

TEST_CASE("a component that the data do not determine keeps its prior, and widens as it did") {
  // It multiplies nearly every sample alike: the albedos take it up.
  auto data = readings(lobe("blinn-phong", .2, .3, 50), polar_grid({0, 20, 40, 60}, 8, 24), {2e-3, 1e-4, 0}, 4);
  data->correlated = {{"lamp", .02, std::vector(data->size(), 1.0)}};
  data->correlated[0].sensitivity[0] = .999;
  const FitResult plain = fit(*observe(data), asking("blinn-phong", {}));
  const FitResult result = fit(*observe(data), asking("blinn-phong", components));
  const NuisanceParameter& found = result.nuisance.front();
  CHECK(*found.sigma == Approx(.02).epsilon(1e-3));
  CHECK(std::abs(found.value) < 1e-3 * .02);
  CHECK(*parameter(result, "rho_d").sigma == Approx(*parameter(plain, "rho_d").sigma).epsilon(.01));
}

TEST_CASE("a tilt counts what a component that is not estimated does to it") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 200);
  const std::vector<GonioAngles> angles = polar_grid({20, 40, 60}, 8, 24);
  auto data = misaligned(truth, angles, {.4 * degree, 0, 0}, {2e-3, 1e-4, 0}, 3);
  const FitResult without = fit(*observe(data), asking("blinn-phong", tilt));
  // An error that follows the slope of the lobe looks like a tilt.
  std::vector<double> sensitivity;
  for (const GonioAngles& a : angles) sensitivity.push_back(std::sin(a.theta_o.radians()) * std::cos(a.phi_o.radians()));
  data->correlated = {{"slope", .05, sensitivity}};
  const FitResult with = fit(*observe(data), asking("blinn-phong", tilt));
  CHECK(*nuisance(with, "tilt_x").sigma > 1.2 * *nuisance(without, "tilt_x").sigma);
}

TEST_CASE("a tilt beyond what a mount can be stops at the bound and is reported there") {
  const auto data = misaligned(lobe("blinn-phong", .2, .3, 30), polar_grid({0, 20, 40, 60}, 8, 24), {8 * degree, 0, 0}, {1e-3, 1e-4, 0}, 2);
  const FitResult result = fit(*observe(data), asking("blinn-phong", tilt));
  CAPTURE(nuisance(result, "tilt_x").value, nuisance(result, "tilt_y").value, *result.errors.chi2_per_dof);
  CHECK(nuisance(result, "tilt_x").value == Approx(5));
  CHECK(!nuisance(result, "tilt_x").sigma);
  bool told = false;
  for (const Check& check : result.checks) told = told || (check.id == "at_bound" && check.detail.find("tilt_x") != std::string::npos);
  CHECK(told);
}

TEST_CASE("observations as corrected are those of an aligned sample without the component") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 50);
  const std::vector<GonioAngles> angles = polar_grid({20, 50}, 20, 60);
  auto data = misaligned(truth, angles, {.01, .02, 0}, {}, 1);
  std::vector<double> sensitivity(data->size(), 0.0);
  for (std::size_t k = 0; k < data->size(); k += 2) sensitivity[k] = -1, data->f[0][k] *= std::exp(-.05);
  data->correlated = {{"range", .1, sensitivity}};
  const auto observations = observe(data);
  const std::vector<NuisanceParameter> found{{"tilt_x", "deg", .01 / degree, {}, {}, {}, {}, {}, 5},
                                             {"tilt_y", "deg", .02 / degree, {}, {}, {}, {}, {}, 5},
                                             {"range", "1", .05, {}, {}, {}, {}, .1, 1}};
  const auto aligned = corrected(*observations, found);
  std::vector<GonioAngles> seen;
  std::vector<LobeGeometry> geometry;
  aligned->angles(0, seen);
  aligned->geometry(0, geometry);
  const ObservationBlock block = aligned->block(0);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    CHECK(block.f[0][k] == Approx(truth.eval(seen[k])[0]).epsilon(1e-12));
    CHECK(geometry[k].cos_i == Approx(std::cos(seen[k].theta_i.radians())));
  }
}

TEST_CASE("nuisance parameters are refused where there can be none, with the reason") {
  auto data = readings(lobe("blinn-phong", .2, .3, 50), polar_grid({20, 50}, 20, 60), {1e-3, 0, 0}, 1);
  const auto refusal = [&](FitOptions options) {
    try {
      fit(*observe(data), options);
    } catch (const Error& error) {
      CHECK(error.kind() == (options.per_channel ? ErrorKind::usage : ErrorKind::input));
      return error.faults().front().found;
    }
    return std::string();
  };
  CHECK(refusal(asking("blinn-phong", components)).find("no correlated component") != std::string::npos);
  data->correlated = {{"scale", .02, {}}};
  CHECK(refusal(asking("blinn-phong", components)).find("no correlated component") != std::string::npos);
  CHECK(refusal(asking("blinn-phong", tilt)).empty());
  data = readings(AnalyticBrdf("blinn-phong", rgb_channels(), {{.2, .3, 50}, {.2, .3, 50}, {.2, .3, 50}}), polar_grid({20, 50}, 20, 60),
                  {1e-3, 0, 0}, 1);
  FitOptions apart = asking("blinn-phong", tilt);
  apart.per_channel = true;
  CHECK(refusal(apart).find("one by one") != std::string::npos);
}
