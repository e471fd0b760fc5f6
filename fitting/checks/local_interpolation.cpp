// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/local_interpolation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fitting/checks/sample_places.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t used_of_each = 7;  // at smaller and at larger theta_i: a cell of a grid has four corners on either
constexpr std::size_t least_of_each = 4;
constexpr double reach_in_spacings = 6;  // grids are often finer in wo than in theta_i
constexpr double kernel_width = 1.5;     // of the farthest sample, so that no side fades away
// Squared distance of the target from the neighbours' centroid in units of their spread: 3 at the end of an evenly covered interval.
constexpr double most_outside = 3;
constexpr double ridge = 1e-9;

std::vector<Point> points_of(const std::vector<GonioAngles>& angles) {
  std::vector<Point> points;
  for (const GonioAngles& a : angles) points.push_back(key_turned(a));
  return points;
}

}  // namespace

LocalInterpolation::LocalInterpolation(const std::vector<GonioAngles>& angles)
    : nodes_(points_of(angles)), reach_(reach_in_spacings * nodes_.median_spacing()) {}

std::optional<LocalInterpolation::Weights> LocalInterpolation::at(const GonioAngles& target, const NearestNodes::Skip& skip) const {
  const Point to = key_turned(target);
  const double theta_i = std::atan2(to[0], to[2]);
  struct Used {
    Neighbour neighbour;
    double kernel;
  };
  std::vector<Used> near;
  double width = 0, closest = INFINITY;
  for (const double side : {-1., 1.}) {
    // Samples at the very incidence count for either side.
    const auto found = nodes_.nearest(to, used_of_each, [&](std::size_t node) {
      const Point& p = nodes_.point(node);
      return side * (std::atan2(p[0], p[2]) - theta_i) < -same_direction_rad || (skip && skip(node));
    });
    if (found.size() < least_of_each) return std::nullopt;
    const double farthest = kernel_width * found.back().distance;
    if (!(farthest > 0)) return std::nullopt;
    width = std::max(width, farthest), closest = std::min(closest, found.front().distance);
    for (const Neighbour& neighbour : found) {
      const double r = neighbour.distance / farthest, t = 1 - r * r * r;
      near.push_back({neighbour, t * t * t});
    }
  }
  if (closest > reach_) return std::nullopt;
  // Columns: 1, theta_i, and wo along the two tangents at the target's wo; lengths in units of the width.
  const double st = std::hypot(to[3], to[4]);
  const double cp = st > 0 ? to[3] / st : 1, sp = st > 0 ? to[4] / st : 0;
  Eigen::Matrix<double, 4, 4> normal = Eigen::Matrix<double, 4, 4>::Zero();
  std::vector<Eigen::Vector4d> rows;
  for (const auto& [neighbour, kernel] : near) {
    const Point& p = nodes_.point(neighbour.node);
    const double x = p[3] - to[3], y = p[4] - to[4], z = p[5] - to[5];
    const double along = (x * cp + y * sp) * to[5] - z * st, across = -x * sp + y * cp;
    rows.emplace_back(1, (std::atan2(p[0], p[2]) - theta_i) / width, along / width, across / width);
    normal += kernel * rows.back() * rows.back().transpose();
  }
  normal.diagonal().tail<3>().array() += ridge;  // samples of one incidence only: no slope in theta_i
  const Eigen::Vector4d solved = normal.ldlt().solve(Eigen::Vector4d::Unit(0));
  // Schur complement: the corner of the inverse times the sum of the kernel is one plus that distance.
  if (!(solved[0] * normal(0, 0) - 1 <= most_outside)) return std::nullopt;
  Weights weights;
  for (std::size_t k = 0; k < near.size(); ++k) weights.emplace_back(near[k].neighbour.node, near[k].kernel * rows[k].dot(solved));
  return weights;
}

}  // namespace gonio::fitting
