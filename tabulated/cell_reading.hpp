// SPDX-License-Identifier: BSD-3-Clause
// Reads the nodes of grid cells, many pairs of directions at a time: the part of a lookup that waits for memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gonio::tabulated {

/// Where the pairs of one batch lie: the lowest corner's number in memory, and the weight of the higher neighbour on each axis.
struct Cells {
  /// Pairs handled at once: the columns below stay in the first-level cache, and the memory requests of one batch overlap.
  static constexpr std::size_t most = 128;

  std::size_t count = 0;
  std::array<std::uint32_t, most> node;
  std::array<std::array<float, most>, 3> weight;
};

/// Numbers in memory, the channels of a node side by side, the last axis the fastest.
template <class T>
struct NodeMemory {
  /// As many numbers more must lie behind the last one: nodes are read in whole vectors.
  static constexpr std::size_t spare = 8;

  const T* first;
  std::size_t channels;
  std::array<std::size_t, 3> stride;  ///< in nodes
};

/// `out` takes [pair · channels + channel]; a half comes as its 16 bits.
template <class T>
void read_nearest(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept;

/// Between the eight corners of each cell: along the first axis, then the second, then the third, each as a + w (b - a). Where a channel
/// of that is NaN, every channel of the pair is the mean of the corners that are known, by their weights, and NaN if none is.
template <class T>
void read_linear(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept;

extern template void read_nearest(const NodeMemory<float>&, const Cells&, float*) noexcept;
extern template void read_nearest(const NodeMemory<std::uint16_t>&, const Cells&, float*) noexcept;
extern template void read_linear(const NodeMemory<float>&, const Cells&, float*) noexcept;
extern template void read_linear(const NodeMemory<std::uint16_t>&, const Cells&, float*) noexcept;

}  // namespace gonio::tabulated
