// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/subset.hpp"

#include <cmath>

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "fitting/joint_observations.hpp"
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

TEST_CASE("a copied part keeps uncertainties, read variances, apertures and correlated components of its samples") {
  const auto data = [](double half_angle, bool with_u) {
    auto out = std::make_shared<Dataset>();
    out->channels = single_channel("Y");
    out->angles = test::polar_grid({10, 40}, 20, 60);
    out->f.resize(1);
    out->apertures.receiver_half_angle_deg = half_angle;
    out->symmetry.isotropic = false;
    out->correlated = {{"scale", 0.02, {}}, {"tilt", 0.1, {}}};
    for (std::size_t k = 0; k < out->size(); ++k) {
      const auto number = static_cast<double>(k);
      out->f[0].push_back(0.1 + 0.01 * number);
      out->correlated[1].sensitivity.push_back(half_angle + number);
      if (!with_u) continue;
      if (out->u.empty()) out->u.resize(1);
      out->u[0].push_back(0.001 * (1 + number));
      out->extra["var_read_Y"].push_back(1e-6 * number);
    }
    return std::shared_ptr<const Observations>(observe(out));
  };
  const auto first = data(0.5, true), second = data(2, false);
  const std::size_t size = sample_count(*first);
  const auto all = join({first, second});
  std::vector<std::uint8_t> keep(2 * size, 0);
  keep[3] = keep[5] = keep[size + 4] = 1;
  const auto part = copied(*all, keep);
  REQUIRE(part->block_count() == 2);
  REQUIRE(sample_count(*part) == 3);
  CHECK_FALSE(part->symmetry().isotropic);
  CHECK(part->apertures(0).receiver_half_angle_deg == 0.5);
  CHECK(part->apertures(1).receiver_half_angle_deg == 2);
  const ObservationBlock one = part->block(0), other = part->block(1);
  CHECK(one.f[0][1] == 0.1 + 0.01 * 5);
  CHECK(one.u.at(0)[1] == 0.001 * 6);
  CHECK(one.read_variance.at(0)[1] == 1e-6 * 5);
  CHECK(other.f[0][0] == 0.1 + 0.01 * 4);
  CHECK(other.u.empty());
  CHECK(other.read_variance.empty());
  const std::vector<CorrelatedComponent> components = part->correlated();
  REQUIRE(components.size() == 2);
  for (const CorrelatedComponent& component : components) CHECK(component.u == (component.name == "scale" ? 0.02 : 0.1));
  const auto tilt = components[0].name == "tilt" ? components[0] : components[1];
  CHECK(tilt.sensitivity == std::vector<double>{3.5, 5.5, 6});
  CHECK(sample_count(*copied(*all, std::vector<std::uint8_t>(2 * size, 0))) == 0);
}
