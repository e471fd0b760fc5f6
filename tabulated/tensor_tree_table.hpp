// SPDX-License-Identifier: BSD-3-Clause
// A BSDF as a tree of cells in Shirley and Chiu's squares.
#pragma once

#include <optional>

#include "brdf/brdf.hpp"
#include "brdf/coordinates.hpp"
#include "brdf/dataset.hpp"
#include "tabulated/formats/sheet_side.hpp"
#include "tabulated/tensor_tree.hpp"

namespace gonio::tabulated {

/// Luminance as a tree, or with u' and v' as trees of their own.
struct TreeChannels {
  TensorTree luminance;
  std::optional<TensorTree> u, v;
};

/// Piecewise constant, as Radiance reads such files (which also shakes each value by up to 2e-4 of it; not done here).
///   3 dimensions (isotropic): (1 - sin theta_i)/2, then the square of the outgoing direction after a turn that brings the light to -x;
///   4 dimensions: the square of the point (-x, -y) of wi, then that of wo.
/// Cells of one level have equal projected solid angles: the hemispherical reflectance is pi times the mean over outgoing cells.
class TensorTreeTable final : public Brdf {
 public:
  TensorTreeTable(TreeChannels trees, SheetSide side);

  /// Channels: `Y`, or r, g, b with Radiance's primaries if there is colour.
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {.isotropic = trees_.luminance.dimensions() == 3, .bilateral = false, .reciprocal = false}; }
  const SheetSide& side() const noexcept { return side_; }
  const TreeChannels& trees() const noexcept { return trees_; }
  using Brdf::eval;
  /// 0 where the pair lies on other sides of the sheet than the table is about.
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

  /// One sample per cell of the luminance, at its centre.
  Dataset samples() const;

 private:
  void value(const TensorTree::Position& at, double* out) const;

  TreeChannels trees_;
  SheetSide side_;
  Channels channels_;
};

/// Where a pair of directions lies in the unit cube of the tree, and back. The y of both is first multiplied by `y_sign`.
TensorTree::Position tree_position(std::size_t dimensions, const Direction& wi, const Direction& wo, double y_sign) noexcept;
DirectionPair tree_directions(std::size_t dimensions, const TensorTree::Position& at, double y_sign) noexcept;

}  // namespace gonio::tabulated
