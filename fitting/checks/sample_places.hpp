// SPDX-License-Identifier: BSD-3-Clause
// Which samples were taken at the same place, and which places are partners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::fitting {

/// Directions closer than this are the same pose: the in-position window of a goniometer. 0.01° moves a lobe of s = 1000 by less than
/// 1 % at its steepest.
inline constexpr double same_direction_rad = 0.01 * 3.14159265358979323846 / 180;

/// A pair of directions as six components: (wi, wo) in the frame of the sample, or turned about the normal so that wi has azimuth 0.
using PlaceKey = std::array<double, 6>;
PlaceKey key_of(const GonioAngles& angles) noexcept;
/// Where either direction is the normal, only the other's zenith angle counts.
PlaceKey key_turned(const GonioAngles& angles) noexcept;
/// The same with both sides of the plane of incidence folded onto one.
PlaceKey key_folded(const GonioAngles& angles) noexcept;
GonioAngles exchanged(const GonioAngles& angles) noexcept;

/// Places found by hashing on a grid a few times coarser than the tolerance and looking into the neighbour cells where needed.
class Places {
 public:
  /// The place within the tolerance of the key, a new one if there is none.
  std::size_t add(const PlaceKey& key);
  std::optional<std::size_t> find(const PlaceKey& key) const;
  std::size_t size() const noexcept { return keys_.size(); }

 private:
  std::vector<PlaceKey> keys_;
  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

/// The mean of the samples of one place and channel.
struct PlaceMean {
  double f = 0, u = 0;         ///< u is NaN if one of the samples has none
  std::vector<double> shared;  ///< f · sensitivity · u of every correlated component
};
/// None if no sample has a value.
std::optional<PlaceMean> mean_of(const Dataset& dataset, std::size_t channel, const std::vector<std::size_t>& samples);

}  // namespace gonio::fitting
