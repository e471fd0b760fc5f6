// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgl_coordinates.hpp"

#include <cmath>
#include <numbers>

#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

/// By even and odd powers apart: two sums half as long, which do not wait for each other.
template <std::size_t N>
[[gnu::always_inline]] inline double polynomial(const std::array<double, N>& coefficients, double t) {
  static_assert(N % 2 == 1);
  const double t2 = t * t;
  double even = coefficients[0], odd = coefficients[1];
  for (std::size_t k = 2; k + 1 < N; k += 2) even = even * t2 + coefficients[k], odd = odd * t2 + coefficients[k + 1];
  return (even * t2 + coefficients[N - 1]) + odd * t;
}

/// asin(sqrt t)/sqrt t on [0, 0.501], highest power first: Chebyshev approximation, error 4e-14.
constexpr std::array<double, 15> arc_sine{0.36770581843346871,  -0.98370830492998576, 1.2736104288856058,   -0.97263438745370331,
                                          0.51182078468262512,  -0.16973712707657799, 0.056791278767487676, 0.0058923122328323756,
                                          0.018359929879436351, 0.022286701473581948, 0.030386645533713039, 0.044642702280730385,
                                          0.075000002658400762, 0.16666666664873583,  1.00000000000002};
/// atan(sqrt t)/sqrt t on [0, 1], the same: error 3e-13.
constexpr std::array<double, 15> arc_tangent{0.00017046040466188238, -0.0014666686334116588, 0.005936376596452122, -0.015232491909076559,
                                             0.028410612112699587,   -0.042324616793255397,  0.054582394542429477, -0.065362288118493733,
                                             0.076631773577540779,   -0.090863606607273319,  0.11110640790649381,  -0.14285684661254053,
                                             0.1999999901342103,     -0.33333333320254712,   0.99999999999969996};

/// The zenith angle of a vector (x, y, z) of this length, z >= 0: twice the arc sine of half its distance to the normal.
[[gnu::always_inline]] inline double zenith_angle(double x, double y, double z, double length) {
  const double t = (x * x + y * y) / (2 * length * (length + z));
  return 2 * std::sqrt(t) * polynomial(arc_sine, t);
}

/// The azimuth of (x, y) in whole turns, from -1/2 to 1/2; 0 of (0, 0).
[[gnu::always_inline]] inline double turn(double y, double x) {
  constexpr double not_zero = 1e-300;
  const double ax = std::fabs(x), ay = std::fabs(y);
  const double small = ax < ay ? ax : ay, large = (ax < ay ? ay : ax) + not_zero;
  const double a = small / large;
  double out = a * polynomial(arc_tangent, a * a) * (0.5 * std::numbers::inv_pi);
  out = ay > ax ? 0.25 - out : out;
  out = x < 0 ? 0.5 - out : out;
  return y < 0 ? -out : out;
}

[[gnu::always_inline]] inline double on_square(double turn) {
  const double y = turn + 0.5;
  return y >= 1 ? y - 1 : y;
}

}  // namespace

GONIO_MULTIVERSION
void find_coordinates(RglPairs& p, bool relative) {
  constexpr double two_over_pi = 2 * std::numbers::inv_pi;
  for (std::size_t k = 0; k < p.count; ++k) {
    p.theta_i[k] = zenith_angle(p.ix[k], p.iy[k], p.iz[k], 1);
    p.incident_x[k] = std::sqrt(p.theta_i[k] * two_over_pi);
    p.turn_i[k] = turn(p.iy[k], p.ix[k]);
    p.incident_y[k] = on_square(p.turn_i[k]);
  }
  for (std::size_t k = 0; k < p.count; ++k) {
    const double hx = p.ix[k] + p.ox[k], hy = p.iy[k] + p.oy[k], hz = p.iz[k] + p.oz[k];
    p.half_x[k] = std::sqrt(zenith_angle(hx, hy, hz, std::sqrt(hx * hx + hy * hy + hz * hz)) * two_over_pi);
    const bool at_normal = !relative || (p.ix[k] == 0 && p.iy[k] == 0);
    const double rx = at_normal ? 1 : p.ix[k], ry = at_normal ? 0 : p.iy[k];
    p.half_y[k] = on_square(turn(hy * rx - hx * ry, hx * rx + hy * ry));
  }
}

}  // namespace gonio::tabulated
