// SPDX-License-Identifier: BSD-3-Clause
// Scattered samples as a table: incident directions by outgoing directions.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::tabulated {

/// A direction as the table's margin holds it.
struct TableDirection {
  double theta_deg = 0, phi_deg = 0;
};

/// m x n cells, row = incident, column = outgoing, cell = row · n + column. An empty cell is NaN with count 0, never 0.
struct SampleTable {
  Dataset description;  ///< everything but samples; the sensitivities of correlated components are below
  std::vector<TableDirection> incident, outgoing;
  std::vector<std::vector<double>> f, u;          ///< [channel][cell] 1/sr; u is NaN where unknown
  std::vector<std::vector<std::uint32_t>> count;  ///< [channel][cell] samples that were averaged
  std::vector<std::vector<double>> sensitivity;   ///< [component][cell], NaN for a component that has none
  /// Pose of the sample less the directions of its row and column (theta_i, phi_i, theta_o, phi_o) in degrees: [4][cell].
  std::array<std::vector<double>, 4> deviation_deg;
  /// How the value of each cell came about (the column `coverage`: 0 measured, 1 interpolated, 2 extrapolated; of several samples the
  /// largest); NaN in empty cells. Empty if the samples do not say.
  std::vector<double> coverage;
  std::vector<std::string> dropped_columns;  ///< optional columns, which a table has no place for

  std::size_t cell_count() const noexcept { return incident.size() * outgoing.size(); }
  /// True if no channel has a sample there.
  bool is_empty(std::size_t cell) const noexcept;
};

/// Directions closer than this are one row or column: coarser than the counts of any drive, far finer than any plan's steps. What
/// the pose of a sample differs from its row and column by is kept beside it.
constexpr double same_direction_deg = 1e-3;
/// Scattered samples with as many directions as samples make no table.
constexpr std::size_t max_table_cells = std::size_t{1} << 24, max_table_directions = std::size_t{1} << 20;

/// The rows and columns are the distinct incident and outgoing directions, sorted by theta, then phi, as absolute azimuths. Samples
/// of one cell become their weighted mean (weights 1/u² where every u of the cell is known, else equal), with
/// u = 1/sqrt(Σ 1/u²) or NaN, and their number. Throws Error(input) if the table would be larger than these limits.
SampleTable tabulate(const Dataset& dataset);

/// The samples of the cells that are not empty, row by row. Averaged cells carry their number as column `n`.
Dataset samples_of(const SampleTable& table);

}  // namespace gonio::tabulated
