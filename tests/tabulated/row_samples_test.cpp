// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/row_samples.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Rows at one direction are one sample; a repeat is another; a missing channel is NaN") {
  const GonioAngles a{30_deg, 0_deg, 40_deg, 180_deg}, b{30_deg, 0_deg, 50_deg, 180_deg};
  const Channels channels{single_channel("x").front(), single_channel("y").front()};
  const RowSamples out = samples_of_rows({{a, 0, 1, 0.1}, {b, 1, 2}, {a, 1, 3}, {a, 0, 4}, {b, 0, 5}}, channels);
  const Dataset& data = out.samples;
  data.require_consistent();
  REQUIRE(data.size() == 3);
  CHECK(out.sample_of == std::vector<std::size_t>{0, 1, 0, 2, 1});
  CHECK(data.f[0] == std::vector<double>{1, 5, 4});
  CHECK(data.f[1][0] == 3);
  CHECK(data.f[1][1] == 2);
  CHECK(std::isnan(data.f[1][2]));
  CHECK(data.u[0][0] == 0.1);
  CHECK(std::isnan(data.u[0][1]));
  CHECK(samples_of_rows({{a, 0, 1}}, single_channel("x")).samples.u.empty());
}
