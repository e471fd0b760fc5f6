// SPDX-License-Identifier: BSD-3-Clause
// A BRDF tabulated on MERL's half/difference grid.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/observations.hpp"
#include "tabulated/merl_grid.hpp"

namespace gonio::tabulated {

/// Three planes (r, g, b) of MERL's 90 x 90 x 180 cells, where they lie; a negative number in any plane masks the cell.
/// The numbers need not be aligned.
struct MerlPlanes {
  std::shared_ptr<const void> owner;     ///< keeps the memory alive
  std::array<const void*, 3> first{};    ///< 1 458 000 doubles each, stored = f / scale
  std::array<double, 3> scale{1, 1, 1};  ///< 1/sr

  /// Scales of the file format (sRGB-like balance of the original camera).
  static constexpr std::array<double, 3> file_scale{1.00 / 1500, 1.15 / 1500, 1.66 / 1500};

  Column column(std::size_t channel) const;
  /// A table in memory, [channel][cell] in 1/sr.
  static MerlPlanes owning(std::array<std::vector<double>, 3> values);
};

/// Evaluates the table: trilinear in (sqrt theta_h, theta_d, phi_d) between the nodes of the rule, exact at nodes, periodic in phi_d,
/// constant beyond the first and last node of the other two. Masked nodes are left out and the weights of the others scaled up; NaN
/// where every node with a weight is masked. 0 below the horizon.
class HalfDifferenceTable final : public Brdf {
 public:
  HalfDifferenceTable(MerlPlanes planes, MerlNodes nodes);

  MerlNodes nodes() const noexcept { return nodes_; }
  const Channels& channels() const override { return channels_; }
  /// Isotropic and reciprocal by construction: the grid has no phi_h, and phi_d + 180° is phi_d.
  Symmetry symmetry() const override { return {.isotropic = true, .bilateral = false, .reciprocal = true}; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

 private:
  MerlPlanes planes_;
  std::array<Column, 3> columns_;
  MerlNodes nodes_;
  Channels channels_;
};

/// The same table for the fitter: 90 blocks of 16 200 cells, theta_h constant over each, straight on the memory.
std::unique_ptr<Observations> observe_merl(MerlPlanes planes, MerlNodes nodes);

}  // namespace gonio::tabulated
