// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/channels.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("quantities are found by the name they print") {
  for (const Quantity q : {Quantity::f, Quantity::f_cos, Quantity::reflectance_factor, Quantity::signal_ratio})
    CHECK(quantity_named(name(q)) == q);
  CHECK_FALSE(quantity_named("radiance").has_value());
}

TEST_CASE("what is unknown of a channel is absent, not zero") {
  const Channel channel = single_channel("value").front();
  CHECK_FALSE(channel.wavelength_in_nm.has_value());
  CHECK_FALSE(channel.polarisation_in.has_value());
  CHECK(rgb_channels()[2].name == "b");
}
