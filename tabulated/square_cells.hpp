// SPDX-License-Identifier: BSD-3-Clause
// The cells of a grid over the unit square that points lie in, many points at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gonio::tabulated {

/// Points that are handled together.
constexpr std::size_t square_batch = 64;
using SquareColumn = std::array<double, square_batch>;

struct SquareCells {
  std::array<std::uint32_t, square_batch> row;
  std::array<std::uint32_t, square_batch> node;  ///< row · columns + column: the cell's first node
  SquareColumn y, x;                             ///< where in the cell, 0 to 1; NaN where the point's coordinate is
};

/// Of the first `count` points. Nodes on the borders, at least 2 rows and columns, fewer than 2^31 nodes. Coordinates beyond the square
/// count as its border.
void find_square_cells(const SquareColumn& y, const SquareColumn& x, std::size_t count, std::size_t rows, std::size_t columns,
                       SquareCells& out) noexcept;

}  // namespace gonio::tabulated
