// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/albedo_quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace gonio::fitting {
namespace {

constexpr std::size_t squares = 96;                           // across the disc; about 7200 squares, finer than any gantry's grid
constexpr double least_reach = 0.01745, most_reach = 0.2618;  // 1° and 15° in radians
constexpr std::size_t neighbours = 3;
constexpr int zenith_steps = 180, azimuth_steps = 360;  // half a degree and one degree

double distance2(const Direction& a, const Direction& b) {
  const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
  return x * x + y * y + z * z;
}

double median_spacing(const std::vector<AlbedoNode>& nodes) {
  std::vector<double> nearest;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < nodes.size(); ++b)
      if (a != b) least = std::min(least, distance2(nodes[a].wo, nodes[b].wo));
    nearest.push_back(std::sqrt(least));
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

/// The nearest samples of a direction, nearest first.
std::array<std::size_t, neighbours> nearest_to(const std::vector<AlbedoNode>& nodes, const Direction& direction, double& least) {
  std::array<std::size_t, neighbours> found{};
  std::array<double, neighbours> distance;
  distance.fill(std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    double d = distance2(nodes[n].wo, direction);
    std::size_t candidate = n;
    for (std::size_t k = 0; k < neighbours; ++k)
      if (d < distance[k]) std::swap(d, distance[k]), std::swap(candidate, found[k]);
  }
  least = std::sqrt(distance[0]);
  return found;
}

}  // namespace

AlbedoEstimate scattered_albedo(const std::vector<AlbedoNode>& nodes) {
  AlbedoEstimate out;
  if (nodes.size() < neighbours) return out;
  const double reach = std::clamp(2 * median_spacing(nodes), least_reach, most_reach);
  std::vector<double> weight(nodes.size(), 0.0);
  double spread = 0, edge = 0;
  std::size_t inside = 0, covered = 0;
  const double side = 2.0 / squares;
  for (std::size_t row = 0; row < squares; ++row)
    for (std::size_t column = 0; column < squares; ++column) {
      const double x = -1 + side * (static_cast<double>(column) + 0.5), y = -1 + side * (static_cast<double>(row) + 0.5),
                   r2 = x * x + y * y;
      if (r2 >= 1) continue;
      ++inside;
      double least = 0;
      const auto near = nearest_to(nodes, Direction::trusted(x, y, std::sqrt(1 - r2)), least);
      if (least > reach) {
        edge = std::max(edge, nodes[near[0]].f);
        continue;
      }
      ++covered;
      weight[near[0]] += 1;
      double low = nodes[near[0]].f, high = low;
      for (const std::size_t n : near) low = std::min(low, nodes[n].f), high = std::max(high, nodes[n].f);
      spread += (high - low) / 2;
    }
  const double area = std::numbers::pi / static_cast<double>(inside);
  out.covered = static_cast<double>(covered) / static_cast<double>(inside);
  double variance = 0;
  std::vector<double> shared(nodes[0].shared.size(), 0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double w = area * weight[n];
    out.albedo += w * nodes[n].f;
    if (std::isfinite(nodes[n].u)) variance += w * w * nodes[n].u * nodes[n].u;
    for (std::size_t k = 0; k < shared.size(); ++k) shared[k] += w * nodes[n].shared[k];
  }
  for (const double value : shared) variance += value * value;
  out.u_noise = std::sqrt(variance);
  out.u_quadrature = area * spread / std::sqrt(3.0);
  out.missing_bound = std::numbers::pi * (1 - out.covered) * edge;
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
