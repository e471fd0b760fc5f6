// SPDX-License-Identifier: BSD-3-Clause
// Triangles of tall matrices with one row per row of the terms, on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fitting/linear_part.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {

inline constexpr std::size_t rows_at_once = 256;     ///< of a block: stays in the first-level cache
inline constexpr std::size_t rows_per_piece = 2048;  ///< of a piece of work; fixed, so that results do not depend on the threads
inline constexpr std::size_t rows_for_threads = 2 * rows_per_piece;  ///< fewer are done in the time that a thread takes to start

/// One triangle per entry of `columns`, its number of columns. `fill(begin, end, blocks)` writes rows [begin, end), at most
/// `rows_at_once`, to the top of one block per triangle; it is called from several threads.
template <class Fill>
std::vector<Triangle> triangles_of_rows(std::size_t rows, const std::vector<std::size_t>& columns, int threads, Fill&& fill) {
  const auto empty = [&] {
    std::vector<Triangle> out;
    for (const std::size_t count : columns) out.emplace_back(count);
    return out;
  };
  const auto fold = [&](std::size_t first, std::size_t last) {
    std::vector<Triangle> out = empty();
    std::vector<Matrix> blocks;
    for (const std::size_t count : columns) blocks.emplace_back(std::min(rows_at_once, last - first), count);
    for (std::size_t begin = first; begin < last; begin += rows_at_once) {
      const std::size_t end = std::min(begin + rows_at_once, last);
      fill(begin, end, blocks);
      for (std::size_t t = 0; t < out.size(); ++t) out[t].add(blocks[t], end - begin);
    }
    return out;
  };
  if (rows <= rows_per_piece) return rows > 0 ? fold(0, rows) : empty();
  std::vector<std::vector<Triangle>> pieces((rows + rows_per_piece - 1) / rows_per_piece);
  for_each_index(pieces.size(), rows >= rows_for_threads ? threads : 1,
                 [&](std::size_t p) { pieces[p] = fold(p * rows_per_piece, std::min(rows, (p + 1) * rows_per_piece)); });
  std::vector<Triangle> out = std::move(pieces.front());
  for (std::size_t p = 1; p < pieces.size(); ++p)
    for (std::size_t t = 0; t < out.size(); ++t) {
      Matrix more = pieces[p][t].r();
      out[t].add(more, more.rows());
    }
  return out;
}

}  // namespace gonio::fitting
