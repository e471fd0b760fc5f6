// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/disk_square.hpp"

#include <cmath>
#include <numbers>

namespace gonio::tabulated {
namespace {

constexpr double eighth_turn = std::numbers::pi / 4;

}  // namespace

std::array<double, 2> square_of_disk(double x, double y) noexcept {
  const double radius = std::hypot(x, y);
  if (radius == 0) return {0.5, 0.5};
  // The quadrant about the x axis is turned onto the right side of the square, the one about the y axis onto the upper side.
  const bool about_x = std::fabs(x) >= std::fabs(y);
  const double along = about_x ? std::copysign(radius, x) : std::copysign(radius, y);
  const double angle = about_x ? std::atan(y / x) : std::atan(x / y);
  const double across = along * angle / eighth_turn;
  const double a = about_x ? along : across, b = about_x ? across : along;
  return {0.5 * (a + 1), 0.5 * (b + 1)};
}

std::array<double, 2> disk_of_square(double u, double v) noexcept {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool about_x = std::fabs(a) >= std::fabs(b);
  const double radius = about_x ? a : b, angle = eighth_turn * (about_x ? b / a : a / b);
  const double along = radius * std::cos(angle), across = radius * std::sin(angle);
  return about_x ? std::array{along, across} : std::array{across, along};
}

}  // namespace gonio::tabulated
