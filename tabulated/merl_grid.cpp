// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/merl_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;

double offset(MerlNodes nodes) { return nodes == MerlNodes::left ? 0.0 : 0.5; }

/// Coordinates in units of cells, from the left edge of the first.
MerlGrid::Position edge_position(const HalfDifference& coordinates) {
  return {std::sqrt(coordinates.theta_h.radians() / (pi / 2)) * MerlGrid::theta_h_count,
          coordinates.theta_d.radians() / (pi / 2) * MerlGrid::theta_d_count,
          fold_phi_d(coordinates.phi_d.radians()) / pi * MerlGrid::phi_d_count};
}

std::size_t floor_below(double value, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
}

double snapped(double value) {
  constexpr double node_snap = 1e-6;
  const double nearest = std::round(value);
  return std::fabs(value - nearest) < node_snap ? nearest : value;
}

}  // namespace

MerlCell MerlGrid::cell_of(const HalfDifference& coordinates) noexcept {
  const Position at = edge_position(coordinates);
  return {floor_below(at.theta_h, theta_h_count), floor_below(at.theta_d, theta_d_count), floor_below(at.phi_d, phi_d_count)};
}

HalfDifference MerlGrid::node(const MerlCell& cell, MerlNodes nodes) noexcept {
  const double shift = offset(nodes);
  const double h = static_cast<double>(cell.theta_h) + shift;
  return {degrees(h * h / 90), degrees(0), degrees(static_cast<double>(cell.theta_d) + shift),
          degrees(static_cast<double>(cell.phi_d) + shift)};
}

MerlGrid::Position MerlGrid::position(const HalfDifference& coordinates, MerlNodes nodes) noexcept {
  const Position at = edge_position(coordinates);
  const double shift = offset(nodes);
  return {snapped(at.theta_h - shift), snapped(at.theta_d - shift), snapped(at.phi_d - shift)};
}

bool above_horizon(const DirectionPair& pair) noexcept {
  constexpr double rounding_of_a_cosine = 1e-15;
  return pair.wi.z() > rounding_of_a_cosine && pair.wo.z() > rounding_of_a_cosine;
}

}  // namespace gonio::tabulated
