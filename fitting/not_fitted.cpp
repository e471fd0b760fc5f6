// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/not_fitted.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fitting/transform.hpp"

namespace gonio::fitting {

const char* name(Omission omission) noexcept {
  switch (omission) {
    case Omission::marked: return "marked";
    case Omission::below_horizon: return "below_horizon";
    case Omission::no_value: return "no_value";
    case Omission::no_uncertainty: return "no_uncertainty";
    case Omission::outside_metric: break;
  }
  return "outside_metric";
}

std::size_t NotFitted::total() const noexcept { return std::accumulate(count_.begin(), count_.end(), std::size_t{0}); }

NotFitted& NotFitted::operator+=(const NotFitted& more) noexcept {
  for (std::size_t k = 0; k < count_.size(); ++k) count_[k] += more.count_[k];
  return *this;
}

std::optional<Omission> omission(const ObservationBlock& block, std::size_t k, double cos_i, double cos_o) {
  if (!block.valid(k)) return Omission::marked;
  if (cos_i < 0 || cos_o < 0) return Omission::below_horizon;
  return std::nullopt;
}

std::optional<Omission> omission(const ObservationBlock& block, std::size_t channel, std::size_t k, const Transform& transform,
                                 double cos_i, bool weighted) {
  const double f = block.f[channel][k];
  if (!std::isfinite(f)) return Omission::no_value;
  if (weighted)
    if (const double u = block.u[channel][k]; !(u > 0 && std::isfinite(u))) return Omission::no_uncertainty;
  if (!transform.defined(f, cos_i)) return Omission::outside_metric;
  return std::nullopt;
}

std::optional<Omission> told(std::optional<Omission> a, std::optional<Omission> b) noexcept {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

}  // namespace gonio::fitting
