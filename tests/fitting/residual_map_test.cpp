// SPDX-License-Identifier: BSD-3-Clause
// The map of residuals is flat for a model that fits and shows where another does not.
#include "fitting/residual_map.hpp"

#include <algorithm>
#include <cmath>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

const ResidualCell& cell(const ResidualMap& map, double theta_i, double theta_o) {
  return map.channel[0][static_cast<std::size_t>(theta_i / 10) * ResidualMap::steps + static_cast<std::size_t>(theta_o / 10)];
}

}  // namespace

TEST_CASE("residuals of the right model have mean 0 and scatter 1 everywhere") {
  const auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({5, 25, 45, 65}, 5, 10), {1e-3, 0, .01}, 3);
  const auto observations = observe(data);
  const ResidualMap map = residual_map(*observations, fit(*observations, {}), 2);
  CHECK(map.n_observations == data->size());
  std::size_t filled = 0;
  for (const ResidualCell& c : map.channel[0]) {
    if (c.count < 30) continue;
    ++filled;
    const double n = static_cast<double>(c.count);
    CHECK(std::abs(c.mean) < 4.5 / std::sqrt(n));  // 4.5: one of 40 cells beyond it in a draw of 4000
    CHECK(std::abs(c.rms - 1) < 4.5 / std::sqrt(2 * n));
  }
  CHECK(filled >= 32);
}

TEST_CASE("a diffuse fit of a lobe shows it where it is") {
  const auto observations = observe(readings(lobe("blinn-phong", .2, .3, 20), polar_grid({45}, 5, 10), {1e-3, 0, 0}, 3));
  FitOptions options;
  options.model = "lambert";
  const ResidualMap map = residual_map(*observations, fit(*observations, options), 1);
  CHECK(cell(map, 45, 45).rms > 10);
  double least = 0;
  for (const ResidualCell& c : map.channel[0]) least = std::min(least, c.mean);
  CHECK(least < -3);
  CHECK(cell(map, 5, 5).count == 0);
}

TEST_CASE("without any uncertainty the residuals are scaled by their own root mean square") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({5, 25, 45, 65}, 5, 10), {1e-3, 0, 0}, 3);
  data->u.clear();
  FitOptions options;
  options.metric = Metric::linear;
  const auto observations = observe(data);
  const ResidualMap map = residual_map(*observations, fit(*observations, options), 1);
  double square = 0, count = 0;
  for (const ResidualCell& c : map.channel[0])
    square += static_cast<double>(c.count) * c.rms * c.rms, count += static_cast<double>(c.count);
  CHECK(square / count == Approx(1));
}
