// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/quantity.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace gonio::tabulated {
namespace {

/// Below this cosine a value that holds cos theta_o says nothing about f: 1e-6 is an elevation of 0.2 seconds of arc, finer than any
/// goniometer can set, and the cosine of 90° that came from rounded radians (6e-17 and more) lies under it.
constexpr double vanishing_cosine = 1e-6;

}  // namespace

double factor_to_f(Quantity quantity, Angle theta_o) noexcept {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const double cos_o = std::fabs(theta_o.cos());
  switch (quantity) {
    case Quantity::f: return 1;
    case Quantity::reflectance_factor: return std::numbers::inv_pi;
    case Quantity::f_cos: return cos_o < vanishing_cosine ? unknown : 1 / cos_o;
    case Quantity::signal_ratio: return cos_o < vanishing_cosine ? unknown : std::numbers::inv_pi / cos_o;
  }
  return unknown;
}

}  // namespace gonio::tabulated
