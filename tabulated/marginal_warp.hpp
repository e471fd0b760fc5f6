// SPDX-License-Identifier: BSD-3-Clause
// The map between a density on the unit square and the uniform density: rows by the marginal, then columns by the conditional.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tabulated/large_array.hpp"
#include "tabulated/square_cells.hpp"

namespace gonio::tabulated {

/// A point of the unit square.
struct UnitPoint {
  double x = 0, y = 0;
};

/// Two neighbours in a list of increasing numbers, and the weight of the second. Beyond the ends the nearest number alone.
struct Neighbours {
  std::size_t low = 0, high = 0;
  double weight = 0;
};
Neighbours neighbours_in(const std::vector<float>& increasing, double at) noexcept;

/// Up to four slices of a table over two parameters and their weights, which sum to 1.
struct SliceWeights {
  std::array<std::size_t, 4> slice{};
  std::array<double, 4> weight{};
};

/// A value between the nodes of a rows x columns grid over the unit square, bilinear; nodes on the borders.
double bilinear(const float* values, std::size_t rows, std::size_t columns, UnitPoint at) noexcept;

/// Bilinear densities on the nodes of a grid over the unit square, one per slice, each normalised to integral 1; between slices the
/// normalised densities and their integrals are mixed linearly (Dupuy and Jakob, "An Adaptive Parameterization for Efficient Material
/// Acquisition and Rendering", 2018, supplement). y is found from the density of whole rows, x from the density inside the row.
/// Everything in double: the integrals are sums of trapezoids, exact for such a density.
class MarginalWarp {
 public:
  MarginalWarp() = default;
  /// `density` is [slice][row][column], finite and >= 0; rows and columns >= 2. A slice whose `integral` is 0 must not be given.
  MarginalWarp(std::vector<float> density, std::size_t rows, std::size_t columns);

  /// What it was made from.
  std::vector<float> density() const;

  /// Where a point goes under the map that makes the density uniform. NaN in x where the whole row has no density: nothing was there.
  UnitPoint invert(const SliceWeights& slices, UnitPoint at) const noexcept;
  /// The same for the first `count` points, which lie in these cells of the grid.
  void invert(const SliceWeights* slices, const SquareCells& cells, std::size_t count, SquareColumn& y, SquareColumn& x) const noexcept;
  /// Begins to bring what `invert` will need from memory.
  void prefetch(const SliceWeights& slices, std::size_t node) const noexcept {
    for (std::size_t k = 0; k < slices.slice.size(); ++k) {
      if (slices.weight[k] == 0) continue;
      __builtin_prefetch(nodes_.data() + node * slices_ + slices.slice[k]);
      __builtin_prefetch(nodes_.data() + (node + columns_) * slices_ + slices.slice[k]);
    }
  }
  /// The inverse of `invert` in one slice. Points are drawn in from the border by 6e-8, as those who write such files do.
  UnitPoint sample(std::size_t slice, UnitPoint uniform) const noexcept;

  /// Integral of one slice in units of grid cells.
  static double integral(const float* density, std::size_t rows, std::size_t columns) noexcept;

 private:
  /// What a look-up needs of one place stands together: it is memory that a look-up waits for.
  struct Node {
    double before;  ///< integral along the row up to the node, normalised
    float density;  ///< as given
    float next;     ///< density of the next node of the row; 0 after the last
  };
  struct Row {
    double before;  ///< integral of the rows up to this one, normalised
    double whole;   ///< integral of the row, normalised
  };

  UnitPoint inverted(const SliceWeights& slices, std::size_t row, std::size_t node, double y, double x) const noexcept;

  std::size_t slices_ = 0, rows_ = 0, columns_ = 0;
  LargeArray<Node> nodes_;     ///< [row][column][slice]: a look-up mixes neighbouring slices
  std::vector<Row> row_sums_;  ///< [slice][row]
  std::vector<double> scale_;  ///< [slice] 1/integral
};

}  // namespace gonio::tabulated
