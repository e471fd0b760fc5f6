// SPDX-License-Identifier: BSD-3-Clause
// Every sample that a fit leaves out is counted once, under its first reason.
#include "fitting/not_fitted.hpp"

#include <cmath>
#include <limits>

#include "fitting/terms.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two channels with u, and samples that have something wrong.
std::shared_ptr<Dataset> flawed() {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({10, 40}, 10, 45), {1e-3, 0, 0}, 4);
  data->channels = {rgb_channels()[0], rgb_channels()[1]};
  data->f.push_back(data->f[0]);
  data->u.push_back(data->u[0]);
  const auto add = [&](double theta_o, double f0, double f1, double u1) {
    data->angles.push_back({degrees(10), degrees(0), degrees(theta_o), degrees(0)});
    data->f[0].push_back(f0), data->f[1].push_back(f1);
    data->u[0].push_back(1e-3), data->u[1].push_back(u1);
  };
  add(120, nan, nan, 1e-3);  // below the horizon, whatever its values
  add(20, .1, nan, 1e-3);    // one channel has a value
  add(20, nan, .1, nan);     // no value in one, no uncertainty in the other: no value is told
  add(20, .1, .1, nan);      // no uncertainty
  add(20, -1, .1, 1e-3);     // negative
  add(20, -1, .1, nan);      // negative in one, no uncertainty in the other
  return data;
}

}  // namespace

TEST_CASE("each sample left out is counted once, under the first of its reasons") {
  const auto data = flawed();
  const Terms linear = make_terms(*observe(data), model_kernel("blinn-phong"), Metric::linear, 1);
  CHECK(linear.not_fitted[Omission::marked] == 0);
  CHECK(linear.not_fitted[Omission::below_horizon] == 1);
  CHECK(linear.not_fitted[Omission::no_value] == 2);
  CHECK(linear.not_fitted[Omission::no_uncertainty] == 2);
  CHECK(linear.not_fitted[Omission::outside_metric] == 0);
  CHECK(linear.not_fitted.total() == 5);
  const Terms log = make_terms(*observe(data), model_kernel("blinn-phong"), Metric::log, 1);
  CHECK(log.not_fitted[Omission::no_uncertainty] == 2);
  CHECK(log.not_fitted[Omission::outside_metric] == 1);
  CHECK(log.not_fitted.total() == 6);
}

TEST_CASE("without uncertainties none is missed") {
  const auto data = flawed();
  data->u.clear();
  const Terms terms = make_terms(*observe(data), model_kernel("blinn-phong"), Metric::linear, 1);
  CHECK(terms.not_fitted[Omission::no_uncertainty] == 0);
  CHECK(terms.not_fitted.total() == 3);
}

TEST_CASE("every reason has a name of its own, and sums keep reasons apart") {
  NotFitted some;
  for (const Omission a : every_omission) {
    some.add(a, 1 + static_cast<std::size_t>(a));
    for (const Omission b : every_omission) CHECK((a == b) == (std::string(name(a)) == name(b)));
  }
  NotFitted twice = some;
  twice += some;
  for (const Omission omission : every_omission) CHECK(twice[omission] == 2 * some[omission]);
  CHECK(twice.total() == 2 * some.total());
  CHECK(!(twice == some));
}
