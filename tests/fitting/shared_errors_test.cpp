// SPDX-License-Identifier: BSD-3-Clause
// A common scale is told from errors that change the shape.
#include "fitting/shared_errors.hpp"

#include <cmath>

#include "fitting/fit.hpp"
#include "tests/fitting/fitted_parameter.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

std::shared_ptr<Dataset> sweep() {
  return readings(lobe("blinn-phong", .2, .3, 20), polar_grid({0, 20, 40, 60}, 10, 30), {1e-3, 1e-4, 0}, 3);
}

}  // namespace

TEST_CASE("components with one sensitivity for all samples are a scale, in squares; others are not") {
  const std::vector<CorrelatedComponent> components{
      {"certificate", .03, {}}, {"lamp", .02, {-2, -2, -2}}, {"range", .05, {1, 0, 1}}, {"tilt", .01, {0, 1, 2}}};
  const SharedErrors apart = shared_errors(components, false);
  REQUIRE(apart.u_scale);
  CHECK(*apart.u_scale == Approx(.05).epsilon(1e-12));
  REQUIRE(apart.shape.size() == 2);
  CHECK(apart.shape[0].name == "range");
  CHECK(apart.shape[1].name == "tilt");
  CHECK(!shared_errors({components[2]}, false).u_scale);
}

TEST_CASE("a common scale stands beside the intervals, and they are those without it") {
  auto data = sweep();
  const FitResult without = fit(*observe(data), {});
  CHECK(!without.u_scale);
  data->correlated = {{"scale", .03, {}}, {"certificate", .04, std::vector(data->size(), 1.0)}};
  const FitResult with = fit(*observe(data), {});
  REQUIRE(with.u_scale);
  CHECK(*with.u_scale == Approx(.05).epsilon(1e-12));
  for (const char* name : {"rho_d", "rho_s", "s"}) {
    CHECK(*parameter(with, name).sigma == Approx(*parameter(without, name).sigma).epsilon(1e-9));
    CHECK(*parameter(with, name).high == Approx(*parameter(without, name).high).epsilon(1e-9));
  }
  // The same for half of the samples is no scale: then it widens.
  data->correlated = {{"range", .05, std::vector(data->size(), 1.0)}};
  for (std::size_t k = 0; k < data->size(); k += 2) data->correlated[0].sensitivity[k] = 0;
  const FitResult half = fit(*observe(data), {});
  CHECK(!half.u_scale);
  CHECK(*parameter(half, "rho_d").sigma > 3 * *parameter(without, "rho_d").sigma);
}

TEST_CASE("where a linear parameter is held the scale acts on the others") {
  auto data = sweep();
  FitOptions options;
  options.fixed["rho_d"] = .2;
  const FitResult without = fit(*observe(data), options);
  data->correlated = {{"scale", .05, {}}};
  const FitResult with = fit(*observe(data), options);
  CHECK(!with.u_scale);
  CHECK(*parameter(with, "s").sigma > 2 * *parameter(without, "s").sigma);
}

TEST_CASE("the energy bound counts the common scale") {
  auto data = sweep();
  const auto u_of = [&] {
    const FitResult result = fit(*observe(data), {});
    for (const Check& check : result.checks)
      if (check.id == "energy_bound") return std::pair(*check.u_effect, *check.effect);
    throw std::out_of_range("energy_bound");
  };
  const auto [u, albedo] = u_of();
  data->correlated = {{"scale", .05, {}}};
  CHECK(u_of().first == Approx(std::hypot(u, .05 * albedo)).epsilon(1e-9));
}
