// SPDX-License-Identifier: BSD-3-Clause
// Built without contraction of products and sums (see CMakeLists.txt), so that every instruction set gives the same bits.
#include "tabulated/square_cells.hpp"

#include <cstring>

#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

typedef double Lanes __attribute__((vector_size(32)));
typedef std::int32_t IntLanes __attribute__((vector_size(16)));
constexpr std::size_t lane_count = 4;
static_assert(square_batch % lane_count == 0);

/// Every choice is one of two numbers by a comparison of the same two, which processors have an instruction for; NaN gives the second.
[[gnu::always_inline]] inline IntLanes find(const double* at, std::size_t nodes, double* part) noexcept {
  const Lanes zero{}, last = zero + static_cast<double>(nodes - 1), before_last = last - 1.0;
  Lanes x;
  std::memcpy(&x, at, sizeof x);
  x *= last;
  x = zero > x ? zero : x;
  x = last < x ? last : x;
  const IntLanes low = __builtin_convertvector(x < before_last ? x : before_last, IntLanes);
  x -= __builtin_convertvector(low, Lanes);
  std::memcpy(part, &x, sizeof x);
  return low;
}

}  // namespace

GONIO_MULTIVERSION
void find_square_cells(const SquareColumn& y, const SquareColumn& x, std::size_t count, std::size_t rows, std::size_t columns,
                       SquareCells& out) noexcept {
  for (std::size_t k = 0; k < count; k += lane_count) {
    const IntLanes row = find(y.data() + k, rows, out.y.data() + k), column = find(x.data() + k, columns, out.x.data() + k);
    const IntLanes node = row * static_cast<std::int32_t>(columns) + column;
    std::memcpy(out.row.data() + k, &row, sizeof row);
    std::memcpy(out.node.data() + k, &node, sizeof node);
  }
}

}  // namespace gonio::tabulated
