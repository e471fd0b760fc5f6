// SPDX-License-Identifier: BSD-3-Clause
// A three-dimensional grid of float or half numbers, looked up in batches as fast as the memory allows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tabulated/large_array.hpp"

namespace gonio::tabulated {

enum class Storage { f32, f16 };
enum class Interpolation { nearest, linear };

/// How a coordinate beyond the first or the last node is taken: as that node, or as the other end.
enum class AxisEnd { clamped, periodic };

/// Nodes lie at 0, 1, 2, ... of each axis: coordinates are in units of nodes. At most 2^31 numbers in all.
struct GridShape {
  std::array<std::size_t, 3> count{};  ///< at least 2 each; the last axis is the fastest in memory
  std::array<AxisEnd, 3> end{};
  std::size_t channels = 1;  ///< interleaved: the channels of a node lie side by side

  std::size_t node_count() const noexcept { return count[0] * count[1] * count[2]; }
};

/// One coordinate per axis and pair of directions, in units of nodes; columns of equal length. A NaN gives NaN.
struct GridCoordinates {
  std::array<std::span<const float>, 3> axis;
  std::size_t size() const noexcept { return axis[0].size(); }
};

/// Unknown values are NaN: an interpolated value is the mean of the nodes that are known, by their weights, and NaN if none is.
///
/// Storage f32 keeps every number; f16 (IEEE 754 binary16) rounds to 11 bits, a relative error of 4.9e-4 between 6.1e-5 and 65504, and
/// loses what is below 3e-8. Every lookup is one of single precision, the same bits whatever the batch and the instruction set: no sum
/// is reordered and no product fused into one (tested against `at`, one by one).
class LookupGrid {
 public:
  /// `values` holds [node · channels + channel]. Throws Error(input) for a shape that does not fit them, a value that is infinite, or one
  /// too large for the storage.
  LookupGrid(GridShape shape, std::span<const double> values, Storage storage);

  const GridShape& shape() const noexcept { return shape_; }
  Storage storage() const noexcept { return storage_; }
  std::size_t bytes() const noexcept;

  /// `out` takes [pair · channels + channel].
  void lookup(const GridCoordinates& at, Interpolation interpolation, std::span<float> out) const;
  /// One pair, by the textbook: what `lookup` is tested against.
  void at(std::array<float, 3> position, Interpolation interpolation, std::span<float> out) const;

 private:
  struct Corner {
    std::size_t node;
    float weight;
  };
  std::array<Corner, 8> corners(std::array<float, 3> position) const noexcept;
  float value(std::size_t node, std::size_t channel) const noexcept;
  void known_mean(std::array<float, 3> position, std::span<float> out) const noexcept;

  GridShape shape_;
  Storage storage_;
  std::array<std::size_t, 3> stored_{};  ///< counts in memory: a periodic axis repeats its first node after its last
  LargeArray<float> f32_;
  LargeArray<std::uint16_t> f16_;
};

/// IEEE 754 binary16: to nearest, ties to even; overflow gives infinity, NaN stays NaN.
std::uint16_t half_from(float value) noexcept;
float float_from(std::uint16_t half) noexcept;

}  // namespace gonio::tabulated
