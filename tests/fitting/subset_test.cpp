// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/subset.hpp"

#include <cmath>

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

TEST_CASE("a fit of a subset is the fit of those samples alone") {
  const auto angles = test::polar_grid({10, 30, 50}, 5, 20);
  const auto all = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 40), angles, {.relative = 0.01}, 3);
  std::vector<std::uint8_t> keep(all->size());
  auto alone = std::make_shared<Dataset>();
  alone->channels = all->channels;
  alone->f.resize(1);
  alone->u.resize(1);
  for (std::size_t k = 0; k < all->size(); ++k) {
    keep[k] = k % 3 != 1;
    if (!keep[k]) continue;
    alone->angles.push_back(all->angles[k]);
    alone->f[0].push_back(all->f[0][k]);
    alone->u[0].push_back(all->u[0][k]);
  }
  const std::shared_ptr<const Observations> whole = observe(all);
  CHECK(sample_count(*whole) == all->size());
  const FitResult some = fit(*subset(whole, keep), {}), only = fit(*observe(alone), {});
  CHECK(some.n_observations == only.n_observations);
  REQUIRE(some.parameters.size() == only.parameters.size());
  for (std::size_t k = 0; k < some.parameters.size(); ++k)
    CHECK(some.parameters[k].value == Approx(only.parameters[k].value).epsilon(1e-12));
}

TEST_CASE("what is no measurement stays none in a subset, and marks must match the samples") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->angles = test::polar_grid({10}, 20, 90);
  data->f = {std::vector<double>(data->size(), 0.1)};
  const std::shared_ptr<const Observations> all = observe(data);
  const auto none = subset(all, std::vector<std::uint8_t>(data->size(), 0));
  for (std::size_t k = 0; k < data->size(); ++k) CHECK_FALSE(none->block(0).valid(k));
  // A subset of a subset holds what both hold.
  std::vector<std::uint8_t> first(data->size(), 0);
  first[2] = 1;
  const auto twice = subset(subset(all, first), std::vector<std::uint8_t>(data->size(), 1));
  for (std::size_t k = 0; k < data->size(); ++k) CHECK(twice->block(0).valid(k) == (k == 2));
  CHECK_THROWS_AS(subset(all, {1, 1}), Error);
}
