// SPDX-License-Identifier: BSD-3-Clause
// Means of a BRDF over cells of pairs of directions.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "brdf/coordinates.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/gauss_legendre.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Tensor products of Gauss-Legendre rules, finer and finer until two of them agree.
class CellMean {
 public:
  /// `orders` of the rules per dimension, increasing. A mean is settled when it differs from the one before by at most
  /// `tolerance` of it, by half of its own uncertainty where the source knows one (as if the errors of a cell went all one way), and
  /// by 1e-6 1/sr, which is nothing beside any surface's 0.3; the three added up.
  CellMean(const Opened& source, const ChannelMap& map, std::vector<std::size_t> orders, double tolerance);

  static constexpr std::size_t max_channels = 3, max_dimensions = 4;
  struct Result {
    std::array<double, max_channels> f{};  ///< of the channels of the map; 0 if nothing is known
    std::array<double, max_channels> u{};  ///< mean standard uncertainty, of points that know theirs; 0 if none does
    double unsettled = 0;                  ///< relative difference of the last two rules if that is too much, else 0
    bool known = false;                    ///< false: NaN at every point; points with NaN are left out of means
  };
  /// The mean over [0, 1]^dimensions, where `pair` gives the directions of a point; equal parts of the cube weigh alike. The first rule
  /// is the first of at least `first_order` points. Counts what was met in `notes`.
  Result operator()(std::size_t dimensions, const std::function<DirectionPair(std::span<const double>)>& pair, std::size_t first_order,
                    ExportNotes& notes) const;

 private:
  Result with_rule(const GaussLegendre& rule, std::size_t dimensions, const std::function<DirectionPair(std::span<const double>)>& pair,
                   ExportNotes& notes) const;

  const Opened& source_;
  const ChannelMap& map_;
  std::vector<GaussLegendre> rules_;
  double tolerance_;
};

/// Adds the counts of `part` to those of `notes`.
void add_counts(const ExportNotes& part, ExportNotes& notes);

}  // namespace gonio::tabulated
