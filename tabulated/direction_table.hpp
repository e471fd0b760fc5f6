// SPDX-License-Identifier: BSD-3-Clause
// Measured samples evaluated as a BRDF at any pair of directions.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::tabulated {

/// Local interpolation by Franke and Nielson's modified inverse distances ("Smooth interpolation of large sets of scattered data",
/// 1980): the nearest `neighbours` samples weigh ((R - d)/(R d))², R the distance of the next one. d is the root of the squared
/// chords between the incident and between the outgoing directions; for isotropic data both pairs are first turned to phi_i = 0, and for
/// bilateral ones to one side of the plane of incidence.
///
/// Exact at measured directions (repeats are averaged); never beyond the range of its neighbours. A peak between samples is
/// therefore cut off: the table knows nothing there. NaN where no sample lies within `reach_deg`, 0 below the horizon (of the
/// transmission side, where wi is below it).
class DirectionTable final : public Brdf {
 public:
  static constexpr std::size_t neighbours = 8;
  static constexpr double reach_deg = 15;

  explicit DirectionTable(std::shared_ptr<const Dataset> dataset) : dataset_(std::move(dataset)) {}

  const Channels& channels() const override { return dataset_->channels; }
  Symmetry symmetry() const override { return dataset_->symmetry; }
  using Brdf::eval;
  /// The first call sorts the samples into a k-d tree: opening a file only to fit it does not pay for it.
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

 private:
  using Point = std::array<double, 6>;
  struct Node {
    Point point;
    std::size_t sample;
  };
  struct Nearest;

  Point point_of(const Direction& wi, const Direction& wo) const;
  void sort(std::size_t first, std::size_t last, std::size_t axis) const;
  void search(const Point& at, std::size_t first, std::size_t last, std::size_t axis, Nearest& nearest) const;

  std::shared_ptr<const Dataset> dataset_;
  mutable std::once_flag once_;
  mutable std::vector<Node> tree_;  ///< the median of each range splits it, axis by axis
};

}  // namespace gonio::tabulated
