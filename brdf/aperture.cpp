// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/aperture.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace gonio {
namespace {

/// Nodes and weights of Gauss-Legendre on [0, 1], by Newton's method on the recurrence of the polynomials.
std::vector<std::pair<double, double>> gauss_legendre(int n) {
  std::vector<std::pair<double, double>> out;
  for (int k = 0; k < n; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double before = 1, p = x;
      for (int j = 2; j <= n; ++j) before = std::exchange(p, ((2 * j - 1) * x * p - (j - 1) * before) / j);
      slope = n * (x * p - before) / (x * x - 1);
      const double move = p / slope;
      x -= move;
      if (std::abs(move) < 1e-15) break;
    }
    out.emplace_back(0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope));
  }
  return out;
}

struct Cone {
  std::vector<Direction> direction;
  std::vector<double> weight;  ///< times the cosine; 0 below the horizon
};

/// Directions of a cone, uniform in solid angle: cos α = 1 - r² (1 - cos half_angle).
Cone cone(Angle theta, Angle phi, double half_angle, const std::vector<DiscNode>& rule) {
  const Direction axis = Direction::spherical(theta, phi);
  const double haversine = std::sin(half_angle / 2);  // 1 - cos = 2 sin²
  Cone out;
  for (const DiscNode& node : rule) {
    const double drop = 2 * haversine * haversine * node.radius * node.radius;  // 1 - cos α
    const double sine = std::sqrt(drop * (2 - drop)), x = sine * std::cos(node.azimuth), y = sine * std::sin(node.azimuth);
    // x along growing zenith angle, y along growing azimuth.
    const double dx = x * theta.cos() * phi.cos() - y * phi.sin(), dy = x * theta.cos() * phi.sin() + y * phi.cos(), dz = -x * theta.sin();
    out.direction.push_back(
        Direction::trusted(axis.x() - drop * axis.x() + dx, axis.y() - drop * axis.y() + dy, axis.z() - drop * axis.z() + dz));
    out.weight.push_back(node.weight * std::max(0.0, out.direction.back().z()));
  }
  return out;
}

}  // namespace

std::vector<DiscNode> disc_rule(int order) {
  if (order <= 0) return {{0, 0, 1}};
  std::vector<DiscNode> out;
  int ring = 0;
  for (const auto& [t, weight] : gauss_legendre(order)) {
    const double turn = (ring++ % 2) * 0.5;  // every other ring by half a step
    for (int k = 0; k < 4 * order; ++k) out.push_back({std::sqrt(t), (k + turn) * std::numbers::pi / (2 * order), weight / (4 * order)});
  }
  return out;
}

std::vector<AperturePair> aperture_pairs(const GonioAngles& angles, const ApertureRule& rule) {
  const Cone source = cone(angles.theta_i, angles.phi_i, rule.source, disc_rule(rule.source_order));
  const Cone receiver = cone(angles.theta_o, angles.phi_o, rule.receiver, disc_rule(rule.receiver_order));
  std::vector<AperturePair> out;
  double sum = 0;
  for (std::size_t i = 0; i < source.direction.size(); ++i)
    for (std::size_t o = 0; o < receiver.direction.size(); ++o) {
      const double w = source.weight[i] * receiver.weight[o];
      if (!(w > 0)) continue;
      out.push_back({source.direction[i], receiver.direction[o], w});
      sum += w;
    }
  for (AperturePair& pair : out) pair.weight /= sum;
  return out;
}

std::size_t aperture_nodes(const GonioAngles& angles, const ApertureRule& rule, std::vector<LobeGeometry>& geometry,
                           std::vector<double>& weight) {
  const std::vector<AperturePair> pairs = aperture_pairs(angles, rule);
  for (const AperturePair& pair : pairs) {
    geometry.push_back(lobe_geometry(pair.wi, pair.wo));
    weight.push_back(pair.weight);
  }
  return pairs.size();
}

}  // namespace gonio
