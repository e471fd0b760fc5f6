// SPDX-License-Identifier: BSD-3-Clause
// Any isotropic BRDF as a grid of single-precision numbers that is looked up in batches.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "brdf/brdf.hpp"
#include "tabulated/lookup_grid.hpp"

namespace gonio::tabulated {

enum class Parameterisation {
  half_difference,  ///< theta_h in [0, 90°], theta_d in [0, 90°], phi_d in [0, 180°): reciprocal by construction, fine near the mirror peak
  spherical,        ///< theta_i, theta_o in [0, 90°], phi_o - phi_i in [0, 360°)
};

/// Where the nodes of an angle lie that is cut into n cells: at the cells' lower edges, in their centres, or at both ends of the range and
/// evenly between.
enum class NodeRule { left, centre, ends };

struct LookupLayout {
  Parameterisation parameterisation = Parameterisation::half_difference;
  std::array<std::size_t, 3> count{90, 90, 180};  ///< nodes of the three angles, in the order above
  NodeRule nodes = NodeRule::left;                ///< of the two zenith angles; azimuths are periodic, with `ends` as `left`
  bool square_root = true;  ///< theta_h = 90° x² instead of 90° x: half of the nodes lie below 22.5° (half_difference only)
};
/// The layout of MERL's files: 90 x 90 x 180, nodes at the left edges unless told otherwise.
constexpr LookupLayout merl_layout(NodeRule nodes = NodeRule::left) {
  return {Parameterisation::half_difference, {90, 90, 180}, nodes, true};
}

/// Unit vectors as columns x, y, z of equal length, in the sample frame and away from the surface.
struct DirectionColumns {
  std::array<std::span<const float>, 3> xyz;
  std::size_t size() const noexcept { return xyz[0].size(); }
};

/// f [1/sr], **cosine not included**, in single precision: 0 below the horizon, NaN where nothing is known. Angles come from the vectors in
/// single precision, without acos and with 1.5e-8 in the arc tangent, so a direction is as exact as its own rounding, 6e-8 rad.
class LookupTable {
 public:
  /// Evaluates the BRDF at the nodes; phi_i is 0 (spherical) or phi_h is (half_difference): what depends on it is lost. Nodes without two
  /// directions above the horizon are unknown, so that a mean next to the horizon is one of those above it.
  LookupTable(const Brdf& brdf, LookupLayout layout, Storage storage, int threads);

  const LookupLayout& layout() const noexcept { return layout_; }
  const Channels& channels() const noexcept { return channels_; }
  const LookupGrid& grid() const noexcept { return grid_; }

  /// The coordinates of pairs on the grid, in units of nodes, each column as long as wi.
  void coordinates(const DirectionColumns& wi, const DirectionColumns& wo, std::array<std::span<float>, 3> out) const;
  /// `out` takes [pair · channels + channel].
  void eval(const DirectionColumns& wi, const DirectionColumns& wo, Interpolation interpolation, std::span<float> out) const;
  /// One pair, the same bits.
  void eval_one(const std::array<float, 3>& wi, const std::array<float, 3>& wo, Interpolation interpolation, std::span<float> out) const;

 private:
  LookupLayout layout_;
  Channels channels_;
  LookupGrid grid_;
};

}  // namespace gonio::tabulated
