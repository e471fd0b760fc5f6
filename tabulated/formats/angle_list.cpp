// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/angle_list.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::tabulated {
namespace {

/// Degrees from radians and back lose less than this.
constexpr double rounding = 1e-9;

}  // namespace

Bracket bracket(std::span<const double> list, double value) noexcept {
  if (list.empty() || !(value >= list.front() - rounding && value <= list.back() + rounding)) return {};
  const auto above = std::upper_bound(list.begin(), list.end(), value);
  if (above == list.begin()) return {0, 0, 0, true};
  const auto high = static_cast<std::size_t>(above - list.begin());
  if (high == list.size()) return {high - 1, high - 1, 0, true};
  const double weight = (value - list[high - 1]) / (list[high] - list[high - 1]);
  return {high - 1, high, weight, true};
}

Bracket bracket_azimuth(std::span<const double> list_deg, double azimuth_deg) noexcept {
  if (list_deg.empty()) return {};
  if (list_deg.size() == 1) return {0, 0, 0, true};
  double azimuth = list_deg.front() + std::fmod(azimuth_deg - list_deg.front(), 360.0);
  if (azimuth < list_deg.front() - rounding) azimuth += 360;
  if (const Bracket inside = bracket(list_deg, azimuth); inside.known) return inside;
  double widest = 0;
  for (std::size_t k = 1; k < list_deg.size(); ++k) widest = std::max(widest, list_deg[k] - list_deg[k - 1]);
  const double gap = list_deg.front() + 360 - list_deg.back();
  if (!(gap > 0) || gap > 2 * widest + rounding) return {};
  return {list_deg.size() - 1, 0, std::clamp((azimuth - list_deg.back()) / gap, 0.0, 1.0), true};
}

}  // namespace gonio::tabulated
