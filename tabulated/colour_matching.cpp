// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/colour_matching.hpp"

#include <algorithm>
#include <cstddef>

namespace gonio::tabulated {
namespace {

constexpr double first_nm = 360, observer_step_nm = 5;
constexpr std::size_t observer_count = 95, daylight_count = 48;

/// The CIE 1931 2° standard observer, every 5 nm from 360 nm.
constexpr std::array<std::array<double, observer_count>, 3> observer{{
    {0.0001299,   0.0002321,   0.0004149,   0.0007416,   0.001368,    0.002236,    0.004243,    0.00765,     0.01431,     0.02319,
     0.04351,     0.07763,     0.13438,     0.21477,     0.2839,      0.3285,      0.34828,     0.34806,     0.3362,      0.3187,
     0.2908,      0.2511,      0.19536,     0.1421,      0.09564,     0.05795,     0.03201,     0.0147,      0.0049,      0.0024,
     0.0093,      0.0291,      0.06327,     0.1096,      0.1655,      0.22575,     0.2904,      0.3597,      0.43345,     0.51205,
     0.5945,      0.6784,      0.7621,      0.8425,      0.9163,      0.9786,      1.0263,      1.0567,      1.0622,      1.0456,
     1.0026,      0.9384,      0.85445,     0.7514,      0.6424,      0.5419,      0.4479,      0.3608,      0.2835,      0.2187,
     0.1649,      0.1212,      0.0874,      0.0636,      0.04677,     0.0329,      0.0227,      0.01584,     0.0113592,   0.00811092,
     0.00579035,  0.00410946,  0.00289933,  0.00204919,  0.00143997,  0.000999949, 0.000690079, 0.000476021, 0.000332301, 0.000234826,
     0.00016615,  0.000117413, 8.30753e-05, 5.87065e-05, 4.15099e-05, 2.93533e-05, 2.06738e-05, 1.45598e-05, 1.0254e-05,  7.22146e-06,
     5.08587e-06, 3.58165e-06, 2.52252e-06, 1.77651e-06, 1.25114e-06},
    {3.917e-06,  6.965e-06,  1.239e-05,  2.202e-05,  3.9e-05,    6.4e-05,    0.00012,   0.000217,  0.000396, 0.00064,    0.00121,
     0.00218,    0.004,      0.0073,     0.0116,     0.01684,    0.023,      0.0298,    0.038,     0.048,    0.06,       0.0739,
     0.09098,    0.1126,     0.13902,    0.1693,     0.20802,    0.2586,     0.323,     0.4073,    0.503,    0.6082,     0.71,
     0.7932,     0.862,      0.91485,    0.954,      0.9803,     0.99495,    1,         0.995,     0.9786,   0.952,      0.9154,
     0.87,       0.8163,     0.757,      0.6949,     0.631,      0.5668,     0.503,     0.4412,    0.381,    0.321,      0.265,
     0.217,      0.175,      0.1382,     0.107,      0.0816,     0.061,      0.04458,   0.032,     0.0232,   0.017,      0.01192,
     0.00821,    0.005723,   0.004102,   0.002929,   0.002091,   0.001484,   0.001047,  0.00074,   0.00052,  0.0003611,  0.0002492,
     0.0001719,  0.00012,    8.48e-05,   6e-05,      4.24e-05,   3e-05,      2.12e-05,  1.499e-05, 1.06e-05, 7.4657e-06, 5.2578e-06,
     3.7029e-06, 2.6078e-06, 1.8366e-06, 1.2934e-06, 9.1093e-07, 6.4153e-07, 4.5181e-07},
    {0.0006061, 0.001086, 0.001946, 0.003486, 0.00645, 0.01055, 0.02005, 0.03621, 0.06785, 0.1102,  0.2074,  0.3713,  0.6456,  1.03905,
     1.3856,    1.62296,  1.74706,  1.7826,   1.77211, 1.7441,  1.6692,  1.5281,  1.28764, 1.0419,  0.81295, 0.6162,  0.46518, 0.3533,
     0.272,     0.2123,   0.1582,   0.1117,   0.07825, 0.05725, 0.04216, 0.02984, 0.0203,  0.0134,  0.00875, 0.00575, 0.0039,  0.00275,
     0.0021,    0.0018,   0.00165,  0.0014,   0.0011,  0.001,   0.0008,  0.0006,  0.00034, 0.00024, 0.00019, 0.0001,  5e-05,   3e-05,
     2e-05,     1e-05,    0,        0,        0,       0,       0,       0,       0,       0,       0,       0,       0,       0,
     0,         0,        0,        0,        0,       0,       0,       0,       0,       0,       0,       0,       0,       0,
     0,         0,        0,        0,        0,       0,       0,       0,       0,       0,       0},
}};

/// Relative power of D65, every 10 nm from 360 nm.
constexpr std::array<double, daylight_count> daylight{
    46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
    115.923, 108.811, 109.354, 107.802, 104.79,  107.689, 104.405, 104.046, 100,     96.3342, 95.788,  88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,
    61.604,  69.8856, 75.087,  63.5927, 46.4182, 66.8054, 63.3828, 64.304,  59.4519, 51.959,  57.4406, 60.3125};

double daylight_at(std::size_t observer_index) {
  const std::size_t low = observer_index / 2;
  return observer_index % 2 == 0 ? daylight[low] : 0.5 * (daylight[low] + daylight[low + 1]);
}

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix inverse(const Matrix& m) {
  Matrix out;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const std::size_t a = (column + 1) % 3, b = (column + 2) % 3, c = (row + 1) % 3, d = (row + 2) % 3;
      out[row][column] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  const double determinant = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
  for (auto& row : out)
    for (double& value : row) value /= determinant;
  return out;
}

/// Tristimulus values of D65, Y = 1.
std::array<double, 3> white() {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < observer_count; ++k) {
      const double weight = k == 0 || k + 1 == observer_count ? 0.5 : 1.0;
      out[c] += weight * observer[c][k] * daylight_at(k);
    }
  const double y = out[1];
  for (double& value : out) value /= y;
  return out;
}

Matrix make_rgb_from_xyz() {
  constexpr std::array<std::array<double, 2>, 3> primaries{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}};
  Matrix xyz_of_primaries;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [x, y] = primaries[c];
    xyz_of_primaries[0][c] = x / y, xyz_of_primaries[1][c] = 1, xyz_of_primaries[2][c] = (1 - x - y) / y;
  }
  Matrix out = inverse(xyz_of_primaries);
  const std::array<double, 3> w = white();
  for (auto& row : out) {
    const double of_white = row[0] * w[0] + row[1] * w[1] + row[2] * w[2];
    for (double& value : row) value /= of_white;
  }
  return out;
}

}  // namespace

const Matrix& rgb_from_xyz() {
  static const Matrix matrix = make_rgb_from_xyz();
  return matrix;
}

std::array<std::vector<double>, 3> rgb_weights(const std::vector<double>& wavelengths_nm) {
  std::array<std::vector<double>, 3> out;
  for (auto& row : out) row.assign(wavelengths_nm.size(), 0.0);
  double luminance_of_white = 0;
  for (std::size_t k = 0; k < observer_count; ++k) {
    const double trapezoid = k == 0 || k + 1 == observer_count ? 0.5 : 1.0, power = trapezoid * daylight_at(k);
    luminance_of_white += power * observer[1][k];
    const double nm = first_nm + observer_step_nm * static_cast<double>(k);
    const auto above = std::upper_bound(wavelengths_nm.begin(), wavelengths_nm.end(), nm);
    std::size_t high = static_cast<std::size_t>(above - wavelengths_nm.begin());
    const std::size_t low = high == 0 ? 0 : high - 1;
    high = std::min(high, wavelengths_nm.size() - 1);
    const double part = high > low ? (nm - wavelengths_nm[low]) / (wavelengths_nm[high] - wavelengths_nm[low]) : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& row = rgb_from_xyz()[c];
      const double response = power * (row[0] * observer[0][k] + row[1] * observer[1][k] + row[2] * observer[2][k]);
      out[c][low] += (1 - part) * response;
      out[c][high] += part * response;
    }
  }
  for (auto& row : out)
    for (double& value : row) value /= luminance_of_white;
  return out;
}

}  // namespace gonio::tabulated
