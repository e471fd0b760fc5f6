// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/joint_observations.hpp"

#include "brdf/error.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

/// Every `parts`-th sample, beginning with `first`.
std::shared_ptr<Dataset> every(const Dataset& all, std::size_t first, std::size_t parts) {
  auto out = std::make_shared<Dataset>(all);
  out->angles.clear();
  for (auto* columns : {&out->f, &out->u})
    for (auto& column : *columns) column.clear();
  for (std::size_t k = first; k < all.size(); k += parts) {
    out->angles.push_back(all.angles[k]);
    for (std::size_t c = 0; c < all.channels.size(); ++c) {
      out->f[c].push_back(all.f[c][k]);
      out->u[c].push_back(all.u[c][k]);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("parts fitted together give the fit of the whole") {
  const auto angles = test::polar_grid({10, 30, 50}, 5, 20);
  auto all = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 40), angles, {.read = 1e-4, .relative = 0.01}, 7);
  all->correlated = {{"scale", 0.02, {}}};
  const FitResult whole = fit(*observe(all), {});
  const FitResult joined = fit(*join({observe(every(*all, 0, 3)), observe(every(*all, 1, 3)), observe(every(*all, 2, 3))}), {});
  REQUIRE(whole.status == Status::converged);
  REQUIRE(joined.status == Status::converged);
  CHECK(joined.n_observations == whole.n_observations);
  constexpr double rounding_of_another_order = 1e-9;  // the exponent is refined to 1e-9 in its logarithm
  for (std::size_t k = 0; k < whole.parameters.size(); ++k) {
    CHECK(joined.parameters[k].value == Approx(whole.parameters[k].value).epsilon(rounding_of_another_order));
    CHECK(*joined.parameters[k].low == Approx(*whole.parameters[k].low).epsilon(1e-6));
    CHECK(*joined.parameters[k].high == Approx(*whole.parameters[k].high).epsilon(1e-6));
  }
}

TEST_CASE("components of one name are one quantity, and each part keeps its own size of it") {
  const auto angles = test::polar_grid({10}, 20, 90);
  const auto part = [&](std::vector<CorrelatedComponent> correlated) {
    auto data = test::readings(test::lobe("phong", 0.2, 0.3, 4), angles, {.relative = 0.01}, 1);
    data->correlated = std::move(correlated);
    return std::shared_ptr<const Observations>(observe(data));
  };
  const auto same = join({part({{"scale", 0.02, {}}}), part({{"scale", 0.02, {}}})})->correlated();
  REQUIRE(same.size() == 1);
  CHECK(same[0].sensitivity.empty());

  const auto mixed =
      join({part({{"scale", 0.02, {}}}), part({{"scale", 0.01, {}}, {"drift", 0.5, std::vector(angles.size(), 2.0)}})})->correlated();
  REQUIRE(mixed.size() == 2);
  const CorrelatedComponent &drift = mixed[0], &scale = mixed[1];
  REQUIRE(drift.sensitivity.size() == 2 * angles.size());
  CHECK(drift.u == 0.5);
  CHECK(drift.sensitivity.front() == 0);
  CHECK(drift.sensitivity.back() == 2);
  CHECK(scale.u == 0.02);
  CHECK(scale.sensitivity.front() == 1);
  CHECK(scale.sensitivity.back() == 0.5);
}

TEST_CASE("parts with different channels are refused") {
  const auto angles = test::polar_grid({10}, 20, 90);
  const auto part = [&](const char* channel) {
    return std::shared_ptr<const Observations>(
        observe(test::readings(AnalyticBrdf("lambert", single_channel(channel), {{0.2}}), angles, {}, 1)));
  };
  CHECK_THROWS_AS(join({part("a"), part("b")}), Error);
  CHECK_THROWS_AS(join({}), Error);
  CHECK_NOTHROW(join({part("a"), part("a")}));
}
