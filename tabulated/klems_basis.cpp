// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/klems_basis.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

namespace gonio::tabulated {
namespace {

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char left, unsigned char right) { return std::tolower(left) == std::tolower(right); });
}

}  // namespace

KlemsBasis::KlemsBasis(std::string name, std::vector<PatchRing> rings) : name_(std::move(name)), rings_(std::move(rings)), first_{0} {
  for (const PatchRing& ring : rings_) {
    cos_upper_.push_back(degrees(ring.upper_deg).cos());
    first_.push_back(first_.back() + ring.patches);
  }
}

const KlemsBasis& KlemsBasis::full() {
  static const KlemsBasis basis(
      "LBNL/Klems Full",
      {{0, 5, 1}, {5, 15, 8}, {15, 25, 16}, {25, 35, 20}, {35, 45, 24}, {45, 55, 24}, {55, 65, 24}, {65, 75, 16}, {75, 90, 12}});
  return basis;
}

const KlemsBasis& KlemsBasis::half() {
  static const KlemsBasis basis(
      "LBNL/Klems Half",
      {{0, 6.5, 1}, {6.5, 19.5, 8}, {19.5, 32.5, 12}, {32.5, 45.5, 16}, {45.5, 58.5, 20}, {58.5, 71.5, 12}, {71.5, 90, 8}});
  return basis;
}

const KlemsBasis& KlemsBasis::quarter() {
  static const KlemsBasis basis("LBNL/Klems Quarter", {{0, 9, 1}, {9, 27, 8}, {27, 45, 12}, {45, 63, 12}, {63, 90, 8}});
  return basis;
}

const KlemsBasis* KlemsBasis::standard(std::string_view name) {
  for (const KlemsBasis* basis : {&full(), &half(), &quarter()})
    if (same_name(name, basis->name())) return basis;
  return nullptr;
}

std::optional<std::size_t> KlemsBasis::patch_of(double x, double y, double z) const noexcept {
  std::size_t ring = 0;
  while (ring < rings_.size() && z <= cos_upper_[ring]) ++ring;
  if (ring == rings_.size()) {
    if (rings_.back().upper_deg < 90) return std::nullopt;
    ring = rings_.size() - 1;  // the horizon itself
  }
  const double turns = std::atan2(y, x) / (2 * std::numbers::pi);
  const std::size_t n = rings_[ring].patches;
  const auto sector = static_cast<std::size_t>((turns < 0 ? turns + 1 : turns) * static_cast<double>(n) + 0.5) % n;
  return first_[ring] + sector;
}

KlemsBasis::Patch KlemsBasis::patch(std::size_t index) const noexcept {
  const auto next = std::upper_bound(first_.begin(), first_.end(), index);
  const auto ring = static_cast<std::size_t>(next - first_.begin()) - 1;
  const double width = 360 / static_cast<double>(rings_[ring].patches);
  return {&rings_[ring], ring, static_cast<double>(index - first_[ring]) * width, width};
}

Angle KlemsBasis::centre_theta(std::size_t index) const noexcept {
  const PatchRing& ring = *patch(index).ring;
  return degrees(ring.patches == 1 ? 0 : 0.5 * (ring.lower_deg + ring.upper_deg));
}

Angle KlemsBasis::centre_phi(std::size_t index) const noexcept { return degrees(patch(index).centre_phi_deg); }

double KlemsBasis::projected_solid_angle(std::size_t index) const noexcept {
  const PatchRing& ring = *patch(index).ring;
  const double lower = degrees(ring.lower_deg).cos(), upper = degrees(ring.upper_deg).cos();
  return std::numbers::pi * (lower * lower - upper * upper) / static_cast<double>(ring.patches);
}

std::optional<std::size_t> KlemsBasis::opposite(std::size_t index) const noexcept {
  const std::size_t ring = patch(index).ring_index, n = rings_[ring].patches;
  if (n == 1) return index;
  if (n % 2 != 0) return std::nullopt;
  return first_[ring] + (index - first_[ring] + n / 2) % n;
}

std::size_t KlemsBasis::mirrored(std::size_t index) const noexcept {
  const std::size_t ring = patch(index).ring_index, n = rings_[ring].patches;
  return first_[ring] + (n - (index - first_[ring])) % n;
}

}  // namespace gonio::tabulated
