// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/albedo_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fitting/checks/nearest_nodes.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t across = 96;                            // across the disc; about 7200 squares, finer than any gantry's grid
constexpr double least_reach = 0.01745, most_reach = 0.2618;  // 1° and 15° in radians
constexpr std::size_t neighbours = 3;
constexpr int zenith_steps = 180, azimuth_steps = 360;  // half a degree and one degree

constexpr double model_trust = 0.25;  // of the change a model makes, for its shape between the samples is assumed

struct Square {
  Direction wo;
  std::size_t node = 0;  ///< the nearest
  double model = 1;
  double half_spread = 0;  ///< of the ratios of the nearest samples
  bool covered = false;
};

std::vector<Square> squares_of(const std::vector<AlbedoNode>& nodes, const AlbedoModel* model) {
  std::vector<Point> points;
  for (const AlbedoNode& node : nodes) points.push_back({node.wo.x(), node.wo.y(), node.wo.z()});
  const NearestNodes tree(std::move(points));
  const double reach = std::clamp(2 * tree.median_spacing(), least_reach, most_reach), side = 2.0 / across;
  std::vector<Square> out;
  for (std::size_t row = 0; row < across; ++row)
    for (std::size_t column = 0; column < across; ++column) {
      const double x = -1 + side * (static_cast<double>(column) + 0.5), y = -1 + side * (static_cast<double>(row) + 0.5),
                   r2 = x * x + y * y;
      if (r2 >= 1) continue;
      Square square;
      square.wo = Direction::trusted(x, y, std::sqrt(1 - r2));
      const auto near = tree.nearest({x, y, square.wo.z()}, neighbours);
      square.node = near.front().node;
      square.covered = near.front().distance <= reach;
      if (model) square.model = model->f(square.wo);
      double low = INFINITY, high = -INFINITY;
      for (const Neighbour& neighbour : near) {
        const double ratio = nodes[neighbour.node].f / nodes[neighbour.node].model;
        low = std::min(low, ratio), high = std::max(high, ratio);
      }
      square.half_spread = (high - low) / 2;
      out.push_back(square);
    }
  return out;
}

}  // namespace

double AlbedoEstimate::u() const { return std::hypot(u_noise, u_scale, u_quadrature); }

AlbedoEstimate scattered_albedo(const std::vector<AlbedoNode>& nodes, const AlbedoModel* model) {
  AlbedoEstimate out;
  if (nodes.size() < neighbours) return out;
  const std::vector<Square> all = squares_of(nodes, model);
  const double area = std::numbers::pi / static_cast<double>(all.size());
  double model_sum = 0, plain_model_sum = 0, missing = 0, edge = 0;
  for (const Square& square : all) {
    model_sum += area * square.model, plain_model_sum += area * nodes[square.node].model;
    if (square.covered) continue;
    missing += area;
    edge = std::max(edge, square.model * nodes[square.node].f / nodes[square.node].model);
  }
  const double scale = model && model_sum > 0 ? model->albedo / model_sum : 1;
  std::vector<double> weight(nodes.size(), 0.0);
  double spread = 0;
  for (const Square& square : all) {
    if (!square.covered) continue;
    weight[square.node] += scale * area * square.model / nodes[square.node].model;
    spread += scale * area * square.model * square.half_spread;
  }
  double variance = 0, changed = 0;
  std::vector<double> shared(nodes[0].shared.size(), 0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    out.albedo += weight[n] * nodes[n].f;
    if (std::isfinite(nodes[n].u)) variance += weight[n] * weight[n] * nodes[n].u * nodes[n].u;
    for (std::size_t k = 0; k < shared.size(); ++k) shared[k] += weight[n] * nodes[n].shared[k];
  }
  if (model) changed = model_trust * std::abs(plain_model_sum - model->albedo);
  out.u_noise = std::sqrt(variance);
  for (const double value : shared) out.u_scale = std::hypot(out.u_scale, value);
  out.u_quadrature = std::hypot(spread / std::sqrt(3.0), changed);
  out.covered = 1 - missing / std::numbers::pi;
  out.missing_bound = missing * std::max(0.0, edge);
  return out;
}

std::vector<AlbedoEstimate> evaluated_albedo(const Brdf& brdf, const Direction& wi) {
  const std::size_t channels = brdf.channels().size();
  struct Sums {
    double fine = 0, coarse = 0, coarse_measure = 0, measure = 0, known = 0, edge = 0;
  };
  std::vector<Sums> sums(channels);
  const std::vector<Direction> incident(azimuth_steps, wi);
  std::vector<Direction> outgoing(azimuth_steps);
  std::vector<double> f(azimuth_steps * channels);
  for (int row = 0; row < zenith_steps; ++row) {
    const double low = std::numbers::pi / 2 * row / zenith_steps, high = std::numbers::pi / 2 * (row + 1) / zenith_steps;
    // ∫ cos θ sin θ dθ over the row: the measure is exact, only f is sampled.
    const double measure = std::numbers::pi / azimuth_steps * (std::sin(high) * std::sin(high) - std::sin(low) * std::sin(low));
    for (int k = 0; k < azimuth_steps; ++k)
      outgoing[static_cast<std::size_t>(k)] =
          Direction::spherical(radians((low + high) / 2), radians(2 * std::numbers::pi * (k + 0.5) / azimuth_steps));
    brdf.eval(incident, outgoing, f);
    for (int k = 0; k < azimuth_steps; ++k)
      for (std::size_t c = 0; c < channels; ++c) {
        const double value = f[static_cast<std::size_t>(k) * channels + c];
        sums[c].measure += measure;
        if (!std::isfinite(value)) continue;
        sums[c].known += measure;
        sums[c].fine += measure * value;
        if (row % 2 == 0) sums[c].coarse += measure * value, sums[c].coarse_measure += measure;
        if (row >= zenith_steps * 3 / 4) sums[c].edge = std::max(sums[c].edge, value);
      }
  }
  std::vector<AlbedoEstimate> out;
  for (const Sums& sum : sums) {
    AlbedoEstimate estimate;
    estimate.albedo = sum.fine;
    estimate.covered = sum.known / sum.measure;
    const double coarse = sum.coarse_measure > 0 ? sum.coarse / sum.coarse_measure * sum.known : 0;
    estimate.u_quadrature = std::abs(sum.fine - coarse);
    estimate.missing_bound = (sum.measure - sum.known) * sum.edge;
    out.push_back(estimate);
  }
  return out;
}

}  // namespace gonio::fitting
