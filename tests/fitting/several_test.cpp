// SPDX-License-Identifier: BSD-3-Clause
// Sums of models: several nonlinear parameters at once, equal lobes in order, bounds and fixed values by name.
#include <cmath>

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// Dense about the mirror direction and over the hemisphere.
std::vector<GonioAngles> lobe_angles() {
  std::vector<GonioAngles> out = polar_grid({5, 30, 60}, 10, 30);
  for (const double theta_i : {10., 40.})
    for (double step = -20; step <= 20; step += 0.5)
      out.push_back({degrees(theta_i), degrees(0), degrees(std::abs(theta_i + step)), degrees(theta_i + step < 0 ? 0 : 180)});
  return out;
}

const FittedParameter& parameter(const FitResult& result, const std::string& name, std::size_t channel = 0) {
  for (const FittedParameter& p : result.parameters)
    if (p.name == name && p.channel.value_or(channel) == channel) return p;
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("two lobes of one model are recovered with the broad one first, whichever way they were made") {
  for (const bool exchanged : {false, true}) {
    const std::vector<double> broad{.3, 15}, narrow{.1, 2000};
    const auto &first = exchanged ? narrow : broad, &second = exchanged ? broad : narrow;
    const AnalyticBrdf truth("blinn-phong+blinn-phong", single_channel("Y"), {{.2, first[0], second[0], first[1], second[1]}});
    FitOptions options;
    options.model = "blinn-phong+blinn-phong";
    const FitResult result = fit(*observe(readings(truth, lobe_angles(), {1e-4, 0, 0.01}, 11)), options);
    REQUIRE(result.status == Status::converged);
    CHECK(parameter(result, "s").value == Approx(15).epsilon(0.1));
    CHECK(parameter(result, "s_2").value == Approx(2000).epsilon(0.1));
    for (std::size_t k = 0; k < 5; ++k) {
      const FittedParameter& p = result.parameters[k];
      const std::vector<double> expected{.2, .3, .1, 15, 2000};
      INFO(p.name << ' ' << p.value << " [" << p.low.value_or(NAN) << ", " << p.high.value_or(NAN) << "] " << name(p.kind));
      CHECK(p.kind == IntervalKind::interval);
      REQUIRE(p.sigma);
      CHECK(std::abs(p.value - expected[k]) < 4 * *p.sigma);
      CHECK((*p.high - *p.low) / 2 == Approx(1.96 * *p.sigma).epsilon(0.1));
    }
  }
}

TEST_CASE("bounds and fixed values hold by name, and wrong ones are refused together") {
  const auto observations = observe(readings(lobe("blinn-phong", .2, .3, 40), polar_grid({10, 40}, 10, 45), {}, 1));
  FitOptions options;
  options.bounds["s"] = {50, 100};
  const FitResult bounded = fit(*observations, options);
  CHECK(parameter(bounded, "s").value == Approx(50));
  options.bounds = {{"rho_s", {0, .25}}, {"rho_d", {.1, .5}}};
  const FitResult linear = fit(*observations, options);
  CHECK(parameter(linear, "rho_s").value == Approx(.25));
  options.bounds = {{"rho_x", {0, 1}}, {"s", {5, 4}}};
  try {
    fit(*observations, options);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.faults().size() == 2);
  }
}
