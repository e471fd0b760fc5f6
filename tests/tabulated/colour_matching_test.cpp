// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/colour_matching.hpp"

#include <cmath>
#include <numeric>

#include "tests/check.hpp"

using namespace gonio::tabulated;

TEST_CASE("The white of the tables is D65 and the matrix that of sRGB") {
  // IEC 61966-2-1, which rounds the white to x = 0.3127, y = 0.3290.
  constexpr double published[3][3] = {
      {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) CHECK(std::fabs(rgb_from_xyz()[row][column] - published[row][column]) < 1e-3);
}

TEST_CASE("A surface that reflects everything is white whatever the wavelengths, one that reflects red light is red") {
  for (const std::vector<double>& wavelengths : {std::vector<double>{550}, {400, 700}, {360, 365.5, 480, 600, 830}})
    for (const auto& row : rgb_weights(wavelengths)) CHECK(std::fabs(std::accumulate(row.begin(), row.end(), 0.0) - 1) < 1e-12);
  const auto weights = rgb_weights({400, 500, 590, 610, 700});
  const auto red = [&](std::size_t c) { return weights[c][3] + weights[c][4]; };
  CHECK(red(0) > 0.5);
  CHECK(red(0) > 5 * red(1));
  CHECK(std::fabs(red(2)) < 0.1);
}

TEST_CASE("The luminance of the primaries is that of the matrix") {
  // Y of (r, g, b) is the middle row of the inverse: weights w with w · M = (0, 1, 0).
  const auto& m = rgb_from_xyz();
  for (std::size_t column = 0; column < 3; ++column) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += luminance_of_rgb[c] * m[c][column];
    CHECK(std::fabs(sum - (column == 1 ? 1 : 0)) < 2e-3);
  }
}
