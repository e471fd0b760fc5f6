// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/dataset.hpp"

#include <cmath>

#include "brdf/error.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

Dataset two_samples() {
  Dataset d;
  d.channels = single_channel("value");
  d.angles = {{10_deg, 0_deg, 10_deg, 180_deg}, {20_deg, 0_deg, 20_deg, 180_deg}};
  d.f = {{0.1, 0.2}};
  d.u = {{0.003, 0.004}};
  return d;
}

}  // namespace

TEST_CASE("the total uncertainty adds every shared component in squares") {
  Dataset d = two_samples();
  d.correlated = {{"scale", 0.02, {}}, {"tilt", 0.001, {0.0, 20.0}}};
  CHECK(d.total_uncertainty(0, 0) == Approx(std::hypot(0.003, 0.1 * 0.02)));
  CHECK(d.total_uncertainty(0, 1) == Approx(std::hypot(0.004, 0.2 * 0.02, 0.2 * 0.02)));
  d.u.clear();
  CHECK(std::isnan(d.total_uncertainty(0, 0)));
}

TEST_CASE("a data set with unequal columns or a zero uncertainty is refused") {
  CHECK_NOTHROW(two_samples().require_consistent());
  Dataset short_f = two_samples();
  short_f.f[0].pop_back();
  CHECK_THROWS_AS(short_f.require_consistent(), Error);
  Dataset zero_u = two_samples();
  zero_u.u[0][1] = 0;
  CHECK_THROWS_AS(zero_u.require_consistent(), Error);
  Dataset unknown_u = two_samples();
  unknown_u.u[0][1] = NAN;
  CHECK_NOTHROW(unknown_u.require_consistent());
}
