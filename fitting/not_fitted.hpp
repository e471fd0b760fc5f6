// SPDX-License-Identifier: BSD-3-Clause
// What a fit left out of the observations, by reason.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "brdf/observations.hpp"

namespace gonio::fitting {

struct Transform;

/// Why a value does not count. Of a sample with several reasons the first of this list is told.
enum class Omission {
  marked,          ///< marked as no measurement in the data: cells of a MERL table with a negative channel
  below_horizon,   ///< a direction below the horizon
  no_value,        ///< f is NaN or infinite
  no_uncertainty,  ///< u is unknown where the data carry u
  outside_metric   ///< f <= 0 under `log`, 1 + f cos θi <= 0 under `log1p`
};
inline constexpr std::array every_omission{Omission::marked, Omission::below_horizon, Omission::no_value, Omission::no_uncertainty,
                                           Omission::outside_metric};
const char* name(Omission omission) noexcept;  ///< as a member of a document: `below_horizon`

/// Numbers of samples with a value left out, each under one reason.
class NotFitted {
 public:
  void add(Omission omission, std::size_t samples = 1) noexcept { count_[static_cast<std::size_t>(omission)] += samples; }
  std::size_t operator[](Omission omission) const noexcept { return count_[static_cast<std::size_t>(omission)]; }
  std::size_t total() const noexcept;
  NotFitted& operator+=(const NotFitted& more) noexcept;
  bool operator==(const NotFitted&) const = default;

 private:
  std::array<std::size_t, every_omission.size()> count_{};
};

/// Why sample `k` is left out as a whole, its directions having these cosines; nothing if its values decide.
std::optional<Omission> omission(const ObservationBlock& block, std::size_t k, double cos_i, double cos_o);
/// Why its value in `channel` is left out; nothing if it counts. `weighted`: only values with a known u count.
std::optional<Omission> omission(const ObservationBlock& block, std::size_t channel, std::size_t k, const Transform& transform,
                                 double cos_i, bool weighted);
/// The one that is told of a sample with both.
std::optional<Omission> told(std::optional<Omission> a, std::optional<Omission> b) noexcept;

}  // namespace gonio::fitting
