// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/importance_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "brdf/error.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/in_parallel.hpp"

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;

/// Points per cell and direction at which the density is looked at, in the middle of equal parts.
constexpr std::size_t points = 3;

/// sin² of half the angle that is the k-th edge of n: 1 - cos theta = 2 sin²(theta/2), which keeps its digits at the peak.
double edge(double k, double n) {
  const double x = k / n, s = std::sin(x * x * pi / 4);
  return s * s;
}

/// The direction with sin²(theta/2) = s2 and azimuth phi.
Direction at(double s2, double phi) {
  const double sin_theta = 2 * std::sqrt(std::max(0.0, s2 * (1 - s2)));
  return Direction::trusted(sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - 2 * s2);
}

Direction reflected(const Direction& wi, const Direction& h) {
  const double twice = 2 * dot(wi, h);
  return Direction::trusted(twice * h.x() - wi.x(), twice * h.y() - wi.y(), twice * h.z() - wi.z());
}

double turned_into_circle(double phi) {
  const double turns = phi / (2 * pi);
  return 2 * pi * (turns - std::floor(turns));
}

}  // namespace

/// Up to four slices, their weights, and the azimuth from which their sectors count.
struct ImportanceSampler::Neighbours {
  std::array<std::size_t, 4> slice{};
  std::array<double, 4> weight{};
  double phi_0 = 0;
};

ImportanceSampler::ImportanceSampler(std::shared_ptr<const Brdf> brdf, SamplerGrid grid, int threads)
    : brdf_(std::move(brdf)), grid_(grid) {
  if (grid.theta_i < 2 || grid.phi_i < 1 || grid.theta_h < 1 || grid.phi_h < 1)
    throw Error(ErrorKind::input, {"the grid of a sampler", "an axis without nodes", "at least 2 incidences, and 1 of the others"});
  // theta = 90° (1 - (1 - x)²): steps shrink towards grazing, where lobes change fastest.
  for (std::size_t k = 0; k < grid.theta_i; ++k) {
    const double x = 1 - static_cast<double>(k) / static_cast<double>(grid.theta_i - 1);
    theta_i_.push_back(pi / 2 * (1 - x * x));
  }
  cumulative_.resize(grid.theta_i * grid.phi_i * cells_per_slice());
  in_parallel(grid.theta_i * grid.phi_i, threads, [this](std::size_t slice) { fill(slice); });
}

void ImportanceSampler::fill(std::size_t slice) {
  // At exactly 90° nothing is reflected; the density of the last slice is that just above the horizon.
  constexpr double highest = pi / 2 - 1e-3;
  const double theta = std::min(theta_i_[slice / grid_.phi_i], highest);
  const double phi = 2 * pi * static_cast<double>(slice % grid_.phi_i) / static_cast<double>(grid_.phi_i);
  const Direction wi = Direction::spherical(radians(theta), radians(phi));
  const ChannelMap luminance = map_to_luminance(brdf_->channels());

  const std::size_t per_cell = points * points, channels = brdf_->channels().size();
  std::vector<Direction> wis, wos;
  std::vector<double> jacobian;
  for (std::size_t i = 0; i < grid_.theta_h; ++i)
    for (std::size_t j = 0; j < grid_.phi_h; ++j)
      for (std::size_t p = 0; p < per_cell; ++p) {
        const auto n = static_cast<double>(grid_.theta_h), middle = (static_cast<double>(p / points) + 0.5) / points;
        const double low = edge(static_cast<double>(i), n), high = edge(static_cast<double>(i + 1), n);
        const double sector = static_cast<double>(j) + (static_cast<double>(p % points) + 0.5) / points;
        const Direction h = at(low + (high - low) * middle, phi + 2 * pi * sector / static_cast<double>(grid_.phi_h));
        const Direction wo = reflected(wi, h);
        wis.push_back(wi), wos.push_back(wo);
        jacobian.push_back(wo.z() > 0 ? (high - low) * wo.z() * 4 * std::max(0.0, dot(wi, h)) : 0);
      }
  std::vector<double> f(wos.size() * channels);
  brdf_->eval(wis, wos, f);

  double sum = 0;
  const std::span<double> cumulative = std::span(cumulative_).subspan(slice * cells_per_slice(), cells_per_slice());
  for (std::size_t cell = 0; cell < cumulative.size(); ++cell) {
    for (std::size_t k = cell * per_cell; k < (cell + 1) * per_cell; ++k) {
      double y = 0;
      luminance.apply(f.data() + k * channels, &y);
      if (y > 0) sum += y * jacobian[k];
    }
    cumulative[cell] = sum;
  }
  for (std::size_t cell = 0; cell < cumulative.size(); ++cell)
    cumulative[cell] = sum > 0 ? cumulative[cell] / sum : static_cast<double>(cell + 1) / static_cast<double>(cumulative.size());
  cumulative.back() = 1;
}

ImportanceSampler::Neighbours ImportanceSampler::neighbours(const Direction& wi) const {
  const double theta = std::min(wi.theta().radians(), pi / 2), phi = turned_into_circle(wi.phi().radians());
  const auto above = static_cast<std::size_t>(std::upper_bound(theta_i_.begin() + 1, theta_i_.end() - 1, theta) - theta_i_.begin());
  const double t = (theta - theta_i_[above - 1]) / (theta_i_[above] - theta_i_[above - 1]);
  Neighbours out;
  if (grid_.phi_i == 1) {
    out.slice = {above - 1, above, above, above};
    out.weight = {1 - t, t, 0, 0};
    out.phi_0 = phi;
    return out;
  }
  const double p = phi / (2 * pi) * static_cast<double>(grid_.phi_i), whole = std::floor(p), s = p - whole;
  const std::size_t low = static_cast<std::size_t>(whole) % grid_.phi_i, high = (low + 1) % grid_.phi_i;
  out.slice = {(above - 1) * grid_.phi_i + low, (above - 1) * grid_.phi_i + high, above * grid_.phi_i + low, above * grid_.phi_i + high};
  out.weight = {(1 - t) * (1 - s), (1 - t) * s, t * (1 - s), t * s};
  return out;
}

DirectionSample ImportanceSampler::sample(const Direction& wi, std::array<double, 2> uniform) const {
  auto [u, v] = uniform;
  DirectionSample out;
  if (u < cosine_share) {
    // Malley: a point of the unit disc, lifted to the hemisphere.
    const double r2 = u / cosine_share, r = std::sqrt(r2), phi = 2 * pi * v;
    out.wo = Direction::trusted(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - r2)));
  } else {
    // Each choice uses up a part of u and leaves the rest uniform.
    u = (u - cosine_share) / (1 - cosine_share);
    const Neighbours near = neighbours(wi);
    std::size_t chosen = 0;
    while (chosen + 1 < near.weight.size() && u >= near.weight[chosen]) u -= near.weight[chosen++];
    u = near.weight[chosen] > 0 ? u / near.weight[chosen] : 0;
    const std::span<const double> cumulative = std::span(cumulative_).subspan(near.slice[chosen] * cells_per_slice(), cells_per_slice());
    const auto found = std::min(std::upper_bound(cumulative.begin(), cumulative.end(), u), cumulative.end() - 1);
    const auto cell = static_cast<std::size_t>(found - cumulative.begin());
    const double before = cell == 0 ? 0 : cumulative[cell - 1];
    const double within = cumulative[cell] > before ? std::clamp((u - before) / (cumulative[cell] - before), 0.0, 1.0) : 0.5;
    const auto ring = static_cast<double>(cell / grid_.phi_h), n = static_cast<double>(grid_.theta_h);
    const double low = edge(ring, n), high = edge(ring + 1, n);
    const double sector = (static_cast<double>(cell % grid_.phi_h) + v) / static_cast<double>(grid_.phi_h);
    out.wo = reflected(wi, at(low + (high - low) * within, near.phi_0 + 2 * pi * sector));
  }
  out.pdf = pdf(wi, out.wo);
  return out;
}

double ImportanceSampler::pdf(const Direction& wi, const Direction& wo) const {
  if (!(wi.z() > 0) || !(wo.z() > 0)) return 0;
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), length = std::hypot(hx, hy, hz);
  const Neighbours near = neighbours(wi);
  // sin²(theta_h/2) from the vector across, not from 1 - cos.
  const double radius = std::hypot(hx, hy), s2 = radius * radius / (2 * length * (length + hz));
  const double x = std::sqrt(std::asin(std::min(1.0, std::sqrt(s2))) * 4 / pi) * static_cast<double>(grid_.theta_h);
  const auto ring = std::min(static_cast<std::size_t>(x), grid_.theta_h - 1);
  const double around = turned_into_circle(std::atan2(hy, hx) - near.phi_0) / (2 * pi) * static_cast<double>(grid_.phi_h);
  const std::size_t cell = ring * grid_.phi_h + std::min(static_cast<std::size_t>(around), grid_.phi_h - 1);

  double share = 0;
  for (std::size_t k = 0; k < near.slice.size(); ++k) {
    const std::size_t first = near.slice[k] * cells_per_slice();
    share += near.weight[k] * (cumulative_[first + cell] - (cell == 0 ? 0 : cumulative_[first + cell - 1]));
  }
  const auto n = static_cast<double>(grid_.theta_h), k = static_cast<double>(ring);
  // Omega of a ring is 2 pi (cos low - cos high) = 4 pi (sin²(high/2) - sin²(low/2)).
  const double omega = 4 * pi * (edge(k + 1, n) - edge(k, n)) / static_cast<double>(grid_.phi_h);
  const double wi_h = length / 2;  // cos theta_d = |wi + wo|/2
  return (1 - cosine_share) * share / (omega * 4 * wi_h) + cosine_share * wo.z() / pi;
}

}  // namespace gonio::tabulated
