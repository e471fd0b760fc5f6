// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/observations.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("a data set is observed in blocks without a copy") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("value");
  const std::size_t n = Observations::max_block + 5;
  data->f.resize(1);
  for (std::size_t k = 0; k < n; ++k) {
    data->angles.push_back({30_deg, 0_deg, degrees(static_cast<double>(k % 90)), 180_deg});
    data->f[0].push_back(static_cast<double>(k));
  }
  const auto observations = observe(data);
  REQUIRE(observations->block_count() > 1);
  std::size_t first = 0;
  for (std::size_t b = 0; b < observations->block_count(); ++b) {
    const ObservationBlock block = observations->block(b);
    REQUIRE(block.size <= Observations::max_block);
    CHECK(block.f[0].data == data->f[0].data() + first);
    CHECK(block.f[0][block.size - 1] == static_cast<double>(first + block.size - 1));
    CHECK(block.u.empty());
    std::vector<LobeGeometry> geometry, some;
    observations->geometry(b, geometry);
    REQUIRE(geometry.size() == block.size);
    CHECK(geometry[0].cos_o == data->angles[first].theta_o.cos());
    const std::vector<std::size_t> last{block.size - 1};
    observations->geometry_of(b, last, some);
    REQUIRE(some.size() == 1);
    CHECK(some[0].cos_o == geometry.back().cos_o);
    first += block.size;
  }
  CHECK(first == n);
}

TEST_CASE("a column of floats with stride and scale reads in double") {
  const float values[] = {1.5f, 0.f, -2.f, 0.f};
  const Column column{values, 2, Column::Type::f32, 0.5};
  CHECK(column[0] == 0.75);
  CHECK(column[1] == -1.0);
}

TEST_CASE("a cell with any negative channel is no measurement where the block says so") {
  const double r[] = {1, 1, -1}, g[] = {1, -0.5, -1};
  ObservationBlock block;
  block.size = 3;
  block.f = {{r}, {g}};
  CHECK(block.valid(1));
  block.validity = ObservationBlock::Validity::no_channel_negative;
  CHECK(block.valid(0));
  CHECK_FALSE(block.valid(1));
  CHECK_FALSE(block.valid(2));
  const std::uint8_t mask[] = {0, 1, 1};
  block.validity = ObservationBlock::Validity::mask;
  block.mask = mask;
  CHECK_FALSE(block.valid(0));
  CHECK(block.valid(1));
}
