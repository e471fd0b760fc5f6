// SPDX-License-Identifier: BSD-3-Clause
// Built without contraction of products and sums (see CMakeLists.txt), so that every instruction set gives the same bits.
#include "tabulated/lookup_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "brdf/error.hpp"
#include "tabulated/cell_reading.hpp"
#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Eight floats or integers, in one register where there is one so wide.
typedef float Lanes __attribute__((vector_size(32)));
typedef std::int32_t IntLanes __attribute__((vector_size(32)));
constexpr std::size_t lane_count = 8;
static_assert(Cells::most % lane_count == 0);

struct Axis {
  Axis(AxisEnd end, std::size_t nodes, std::size_t stride_in_nodes)
      : circle(end == AxisEnd::periodic),
        count(static_cast<float>(nodes)),
        per_turn(1 / count),
        highest(circle ? count : count - 2),
        stride(static_cast<std::int32_t>(stride_in_nodes)) {}

  bool circle;
  float count;     ///< of nodes
  float per_turn;  ///< 1/count
  float highest;   ///< that has a higher neighbour
  std::int32_t stride;
};

/// Farther round a circle a position is not counted in turns: it is nonsense, but must stay in the table.
constexpr float most_turns = 0x1p24f;

/// What lies on the axis, from 0 up to the last node (clamped) or below `count` (periodic).
float on_axis(const Axis& axis, float x) noexcept {
  if (!axis.circle) return std::clamp(x, 0.0f, axis.count - 1);
  x -= std::trunc(std::clamp(x * axis.per_turn, -most_turns, most_turns)) * axis.count;
  x = std::max(x < 0 ? x + axis.count : x, 0.0f);
  return x < axis.count ? x : 0;
}

/// The same for a batch, and with it the node and weights. Positions that are NaN count as 0; true if there is one. Every choice is one of
/// two numbers by a comparison of the same two, which processors have an instruction for; NaN gives the second.
template <bool nearest>
[[gnu::always_inline]] inline bool find_cells_of(const std::array<Axis, 3>& axes, const std::array<const float*, 3>& position,
                                                 Cells& cells) noexcept {
  IntLanes nowhere{};
  for (std::size_t k = 0; k < cells.count; k += lane_count) {
    IntLanes node{};
    for (std::size_t a = 0; a < 3; ++a) {
      const Axis& axis = axes[a];
      const Lanes zero{}, count = zero + axis.count;
      Lanes x;
      std::memcpy(&x, position[a] + k, sizeof x);
      nowhere |= x != x;
      if (nearest) x += 0.5f;
      if (axis.circle) {
        const Lanes most = zero + most_turns, least = zero - most_turns;
        Lanes turns = x * axis.per_turn;
        turns = turns < most ? turns : most;
        turns = turns > least ? turns : least;
        x -= __builtin_convertvector(__builtin_convertvector(turns, IntLanes), Lanes) * count;
        x = x < zero ? x + count : x;
        x = x > zero ? x : zero;
        x = x < count ? x : zero;
      } else {
        const Lanes last = count - 1.0f;
        x = x > zero ? x : zero;
        x = x < last ? x : last;
      }
      if (nearest) {
        node += __builtin_convertvector(x, IntLanes) * axis.stride;
        continue;
      }
      const Lanes highest = zero + axis.highest;
      const IntLanes low = __builtin_convertvector(x < highest ? x : highest, IntLanes);
      const Lanes weight = x - __builtin_convertvector(low, Lanes);
      std::memcpy(cells.weight[a].data() + k, &weight, sizeof weight);
      node += low * axis.stride;
    }
    std::memcpy(cells.node.data() + k, &node, sizeof node);
  }
  std::int32_t any = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) any |= nowhere[lane];
  return any != 0;
}

GONIO_MULTIVERSION bool find_cells(const std::array<Axis, 3>& axes, const std::array<const float*, 3>& position,
                                   Interpolation interpolation, Cells& cells) noexcept {
  return interpolation == Interpolation::nearest ? find_cells_of<true>(axes, position, cells) : find_cells_of<false>(axes, position, cells);
}

}  // namespace

LookupGrid::LookupGrid(GridShape shape, std::span<const double> values, Storage storage) : shape_(shape), storage_(storage) {
  constexpr std::size_t largest = std::size_t{1} << 31;
  std::size_t numbers = shape.channels;
  for (std::size_t a = 0; a < 3; ++a) {
    if (shape.count[a] < 2 || shape.count[a] > largest)
      throw Error(ErrorKind::input, {fmt::format("axis {} of a grid", a), fmt::format("{} nodes", shape.count[a]), "at least 2"});
    stored_[a] = shape.count[a] + (shape.end[a] == AxisEnd::periodic ? 1 : 0);
    numbers = numbers > largest ? numbers : numbers * stored_[a];
  }
  if (shape.channels == 0 || numbers > largest || values.size() != shape.node_count() * shape.channels)
    throw Error(ErrorKind::input, {"a grid", fmt::format("{} numbers", values.size()),
                                   fmt::format("{} x {} x {} nodes of {} channels, at most 2^31 numbers", shape.count[0], shape.count[1],
                                               shape.count[2], shape.channels)});
  const auto fill = [&](auto& memory, auto&& stored) {
    memory.resize(numbers + NodeMemory<float>::spare);
    std::size_t next = 0;
    for (std::size_t i = 0; i < stored_[0]; ++i)
      for (std::size_t j = 0; j < stored_[1]; ++j)
        for (std::size_t k = 0; k < stored_[2]; ++k) {
          const std::size_t node = ((i % shape.count[0]) * shape.count[1] + j % shape.count[1]) * shape.count[2] + k % shape.count[2];
          for (std::size_t c = 0; c < shape.channels; ++c) {
            const auto value = static_cast<float>(values[node * shape.channels + c]);
            memory[next++] = stored(value);
            if (std::isinf(value) || (storage == Storage::f16 && std::isinf(float_from(half_from(value)))))
              throw Error(ErrorKind::input, {fmt::format("node {} of a grid", node), fmt::format("{}", values[node * shape.channels + c]),
                                             storage == Storage::f16 ? "numbers up to 65504" : "numbers that fit a float"});
          }
        }
  };
  if (storage == Storage::f32)
    fill(f32_, [](float value) { return value; });
  else
    fill(f16_, [](float value) { return half_from(value); });
}

std::size_t LookupGrid::bytes() const noexcept { return f32_.size() * sizeof(float) + f16_.size() * sizeof(std::uint16_t); }

void LookupGrid::lookup(const GridCoordinates& at, Interpolation interpolation, std::span<float> out) const {
  const std::size_t channels = shape_.channels, n = at.size();
  const std::array<std::size_t, 3> stride{stored_[1] * stored_[2], stored_[2], 1};
  const auto axis = [&](std::size_t a) { return Axis(shape_.end[a], shape_.count[a], stride[a]); };
  const std::array<Axis, 3> axes{axis(0), axis(1), axis(2)};
  std::array<std::array<float, Cells::most>, 3> last_positions{};
  Cells cells;
  for (std::size_t first = 0; first < n; first += Cells::most) {
    cells.count = std::min(Cells::most, n - first);
    std::array<const float*, 3> position;
    for (std::size_t a = 0; a < 3; ++a) {
      position[a] = at.axis[a].data() + first;
      // Positions are read in whole vectors.
      if (cells.count < Cells::most) position[a] = std::copy_n(position[a], cells.count, last_positions[a].begin()) - cells.count;
    }
    const bool some_nowhere = find_cells(axes, position, interpolation, cells);
    float* const values = out.data() + first * channels;
    const auto read = [&]<class T>(const T* memory) {
      const NodeMemory<T> nodes{memory, channels, stride};
      interpolation == Interpolation::nearest ? read_nearest(nodes, cells, values) : read_linear(nodes, cells, values);
    };
    storage_ == Storage::f32 ? read(f32_.data()) : read(f16_.data());
    for (std::size_t k = 0; some_nowhere && k < cells.count; ++k)
      if (std::isnan(position[0][k]) || std::isnan(position[1][k]) || std::isnan(position[2][k]))
        std::fill_n(values + k * channels, channels, unknown);
  }
}

std::array<LookupGrid::Corner, 8> LookupGrid::corners(std::array<float, 3> position) const noexcept {
  std::array<Corner, 8> out;
  out.fill({0, 1});
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis axis(shape_.end[a], shape_.count[a], 0);
    const float x = on_axis(axis, position[a]), low = std::min(std::trunc(x), axis.highest), weight = x - low;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const bool high = (corner >> (2 - a) & 1) != 0;
      out[corner].node = out[corner].node * stored_[a] + static_cast<std::size_t>(low) + (high ? 1 : 0);
      out[corner].weight *= high ? weight : 1 - weight;
    }
  }
  return out;
}

float LookupGrid::value(std::size_t node, std::size_t channel) const noexcept {
  const std::size_t at = node * shape_.channels + channel;
  return storage_ == Storage::f32 ? f32_[at] : float_from(f16_[at]);
}

void LookupGrid::known_mean(std::array<float, 3> position, std::span<float> out) const noexcept {
  for (std::size_t c = 0; c < out.size(); ++c) {
    float sum = 0, weights = 0;
    for (const Corner& corner : corners(position)) {
      const float at_corner = value(corner.node, c);
      if (!(corner.weight > 0) || std::isnan(at_corner)) continue;
      sum += corner.weight * at_corner;
      weights += corner.weight;
    }
    out[c] = weights > 0 ? sum / weights : unknown;
  }
}

void LookupGrid::at(std::array<float, 3> position, Interpolation interpolation, std::span<float> out) const {
  if (std::any_of(position.begin(), position.end(), [](float x) { return std::isnan(x); })) {
    std::fill(out.begin(), out.end(), unknown);
    return;
  }
  if (interpolation == Interpolation::nearest) {
    std::size_t node = 0;
    for (std::size_t a = 0; a < 3; ++a)
      node = node * stored_[a] + static_cast<std::size_t>(on_axis(Axis(shape_.end[a], shape_.count[a], 0), position[a] + 0.5f));
    for (std::size_t c = 0; c < shape_.channels; ++c) out[c] = value(node, c);
    return;
  }
  std::array<float, 3> weight{};
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis axis(shape_.end[a], shape_.count[a], 0);
    const float x = on_axis(axis, position[a]);
    weight[a] = x - std::min(std::trunc(x), axis.highest);
  }
  const std::array<Corner, 8> corner = corners(position);
  bool whole = true;
  for (std::size_t c = 0; c < shape_.channels; ++c) {
    std::array<float, 8> v;
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = value(corner[k].node, c);
    const auto between = [](float a, float b, float w) { return a + w * (b - a); };
    for (std::size_t k = 0; k < 4; ++k) v[k] = between(v[k], v[k + 4], weight[0]);
    for (std::size_t k = 0; k < 2; ++k) v[k] = between(v[k], v[k + 2], weight[1]);
    out[c] = between(v[0], v[1], weight[2]);
    whole &= !std::isnan(out[c]);
  }
  if (!whole) known_mean(position, out);
}

std::uint16_t half_from(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
  const float magnitude = std::fabs(value);
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7e00u);
  // Halfway between the largest half, 65504, and what would be the next.
  if (magnitude >= 65520.0f) return static_cast<std::uint16_t>(sign | 0x7c00u);
  // Adding a number whose last bit is the half's last bit lets the float unit round, ties to even.
  const int exponent = std::max(magnitude > 0 ? std::ilogb(magnitude) : -14, -14);
  const float unit = std::ldexp(1.0f, exponent - 10);
  const auto units = static_cast<std::uint32_t>(std::nearbyint(magnitude / unit));
  // A normal number has 1024 to 2048 units, 2048 being 1024 of the next exponent; a denormal one fewer than 1024.
  const std::uint32_t rest = units >= 1024 ? units - 1024 + (static_cast<std::uint32_t>(exponent + 15) << 10) : units;
  return static_cast<std::uint16_t>(sign | rest);
}

float float_from(std::uint16_t half) noexcept {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000u) << 16, exponent = half >> 10 & 31u, rest = half & 1023u;
  if (exponent == 31) return std::bit_cast<float>(sign | (rest == 0 ? 0x7f800000u : 0x7fc00000u));
  const float magnitude = exponent == 0 ? std::ldexp(static_cast<float>(rest), -24)
                                        : std::ldexp(static_cast<float>(rest + 1024), static_cast<int>(exponent) - 25);
  return sign == 0 ? magnitude : -magnitude;
}

}  // namespace gonio::tabulated
