// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/sample_places.hpp"

#include <cmath>

namespace gonio::fitting {
namespace {

constexpr double cell_size = 8 * same_direction_rad;

std::uint64_t hash_of(const std::array<std::int64_t, 6>& cell) {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a over the six cell numbers
  for (const std::int64_t number : cell) hash = (hash ^ static_cast<std::uint64_t>(number)) * 1099511628211u;
  return hash;
}

std::array<std::int64_t, 6> cell_of(const PlaceKey& key) {
  std::array<std::int64_t, 6> cell{};
  for (std::size_t k = 0; k < key.size(); ++k) cell[k] = static_cast<std::int64_t>(std::floor(key[k] / cell_size));
  return cell;
}

bool same(const PlaceKey& a, const PlaceKey& b) {
  const double i = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), o = std::hypot(a[3] - b[3], a[4] - b[4], a[5] - b[5]);
  return i <= same_direction_rad && o <= same_direction_rad;
}

}  // namespace

PlaceKey key_of(const GonioAngles& angles) noexcept {
  const Direction wi = angles.wi(), wo = angles.wo();
  return {wi.x(), wi.y(), wi.z(), wo.x(), wo.y(), wo.z()};
}

PlaceKey key_turned(const GonioAngles& angles) noexcept {
  const Direction wi = angles.wi(), wo = angles.wo();
  const double si = std::hypot(wi.x(), wi.y()), so = std::hypot(wo.x(), wo.y());
  if (si < same_direction_rad || so < same_direction_rad) return {si, 0, wi.z(), so, 0, wo.z()};
  const double cosine = (wi.x() * wo.x() + wi.y() * wo.y()) / si, sine = (wi.x() * wo.y() - wi.y() * wo.x()) / si;
  return {si, 0, wi.z(), cosine, sine, wo.z()};
}

PlaceKey key_folded(const GonioAngles& angles) noexcept {
  PlaceKey key = key_turned(angles);
  key[4] = std::abs(key[4]);
  return key;
}

GonioAngles exchanged(const GonioAngles& angles) noexcept { return {angles.theta_o, angles.phi_o, angles.theta_i, angles.phi_i}; }

std::optional<std::size_t> Places::find(const PlaceKey& key) const {
  // Every corner of the tolerance box; most keys lie inside one cell and give the same corner 64 times over, hence the masks.
  const auto low = cell_of([&] {
    PlaceKey k = key;
    for (double& v : k) v -= same_direction_rad;
    return k;
  }());
  const auto high = cell_of([&] {
    PlaceKey k = key;
    for (double& v : k) v += same_direction_rad;
    return k;
  }());
  unsigned split = 0;
  for (unsigned k = 0; k < 6; ++k)
    if (low[k] != high[k]) split |= 1u << k;
  for (unsigned mask = split;; mask = (mask - 1) & split) {
    auto cell = low;
    for (unsigned k = 0; k < 6; ++k)
      if (mask & (1u << k)) cell[k] = high[k];
    const auto [begin, end] = cells_.equal_range(hash_of(cell));
    for (auto entry = begin; entry != end; ++entry)
      if (same(keys_[entry->second], key)) return entry->second;
    if (mask == 0) return std::nullopt;
  }
}

std::size_t Places::add(const PlaceKey& key) {
  if (const auto known = find(key)) return *known;
  cells_.emplace(hash_of(cell_of(key)), keys_.size());
  keys_.push_back(key);
  return keys_.size() - 1;
}

std::optional<PlaceMean> mean_of(const Dataset& dataset, std::size_t channel, const std::vector<std::size_t>& samples) {
  PlaceMean mean;
  mean.shared.assign(dataset.correlated.size(), 0.0);
  double n = 0, variance = 0;
  for (const std::size_t sample : samples) {
    const double f = dataset.f[channel][sample];
    if (!std::isfinite(f)) continue;
    const double u = dataset.has_uncertainty() ? dataset.u[channel][sample] : std::nan("");
    n += 1;
    mean.f += f;
    variance += u * u;
    for (std::size_t k = 0; k < mean.shared.size(); ++k) {
      const CorrelatedComponent& component = dataset.correlated[k];
      mean.shared[k] += f * component.u * (component.sensitivity.empty() ? 1 : component.sensitivity[sample]);
    }
  }
  if (n == 0) return std::nullopt;
  mean.f /= n;
  mean.u = std::sqrt(variance) / n;
  for (double& value : mean.shared) value /= n;
  return mean;
}

}  // namespace gonio::fitting
