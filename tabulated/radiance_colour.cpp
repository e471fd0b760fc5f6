// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/radiance_colour.hpp"

namespace gonio::tabulated {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;  ///< rows

constexpr Matrix inverse(const Matrix& m) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = cofactor(j, i) / determinant;
  return out;
}

constexpr Triple product(const Matrix& m, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

/// Columns are the primaries, scaled so that r = g = b = 1 is X = Y = Z = 1.
constexpr Matrix xyz_matrix() {
  constexpr std::array<std::array<double, 2>, 3> primaries{{{0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}}};
  Matrix out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [x, y] = primaries[c];
    out[0][c] = x, out[1][c] = y, out[2][c] = 1 - x - y;
  }
  const Triple scale = product(inverse(out), {1, 1, 1});
  for (Triple& row : out)
    for (std::size_t c = 0; c < 3; ++c) row[c] *= scale[c];
  return out;
}

constexpr Matrix to_xyz = xyz_matrix();
constexpr Matrix to_rgb = inverse(to_xyz);

}  // namespace

Triple xyz_of_rgb(const Triple& rgb) noexcept { return product(to_xyz, rgb); }
Triple rgb_of_xyz(const Triple& xyz) noexcept { return product(to_rgb, xyz); }

std::array<double, 2> uv_of_xyz(const Triple& xyz) noexcept {
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  if (!(sum > 0)) return uv_of_xyz({1, 1, 1});
  return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

Triple xyz_of_yuv(double luminance, double u, double v) noexcept {
  return {luminance * 9 * u / (4 * v), luminance, luminance * (12 - 3 * u - 20 * v) / (4 * v)};
}

}  // namespace gonio::tabulated
