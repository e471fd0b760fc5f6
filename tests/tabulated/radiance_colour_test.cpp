// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/radiance_colour.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Colours go to XYZ and to Y, u', v' and come back") {
  test::Random random(test::seed);
  for (int k = 0; k < 1000; ++k) {
    const std::array<double, 3> rgb{test::uniform(random, 0, 2), test::uniform(random, 0, 2), test::uniform(random, 0, 2)};
    const auto xyz = xyz_of_rgb(rgb);
    const auto [u, v] = uv_of_xyz(xyz);
    const auto back = rgb_of_xyz(xyz_of_yuv(xyz[1], u, v));
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::fabs(back[c] - rgb[c]) < 1e-12);
  }
}

TEST_CASE("Grey has equal X, Y, Z, and luminance has the weights of Radiance") {
  for (const double value : xyz_of_rgb({0.3, 0.3, 0.3})) CHECK(value == Approx(0.3).epsilon(1e-14));
  CHECK(xyz_of_rgb({1, 0, 0})[1] == Approx(0.265).margin(5e-4));
  CHECK(xyz_of_rgb({0, 1, 0})[1] == Approx(0.670).margin(5e-4));
  CHECK(xyz_of_rgb({0, 0, 1})[1] == Approx(0.065).margin(5e-4));
  CHECK(uv_of_xyz({0, 0, 0}) == uv_of_xyz({1, 1, 1}));
}
