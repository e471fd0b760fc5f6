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
#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Pairs handled at once: the columns below stay in the first-level cache, and the memory requests of one batch overlap.
constexpr std::size_t batch = 128;

/// Four floats in one register: the channels of a node, and whatever lies behind them.
typedef float Lanes __attribute__((vector_size(16)));
typedef std::uint16_t HalfLanes __attribute__((vector_size(8)));
typedef std::uint32_t BitLanes __attribute__((vector_size(16)));
constexpr std::size_t lane_count = 4;

inline Lanes load(const float* from) noexcept {
  Lanes out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

/// The bits of a half in a float's place are the number times 2^-112; what had the largest exponent (NaN) becomes 2^16 and more.
inline Lanes load(const std::uint16_t* from) noexcept {
  HalfLanes halfs;
  std::memcpy(&halfs, from, sizeof halfs);
  const BitLanes bits = __builtin_convertvector(halfs, BitLanes);
  const BitLanes magnitude = (bits & 0x7fffu) << 13, sign = (bits & 0x8000u) << 16;
  Lanes scaled;
  std::memcpy(&scaled, &magnitude, sizeof scaled);
  scaled *= 0x1p112f;
  BitLanes all;
  std::memcpy(&all, &scaled, sizeof all);
  const BitLanes is_nan = reinterpret_cast<BitLanes>(scaled >= 65536.0f) & 0x7fc00000u;
  all |= sign | is_nan;
  std::memcpy(&scaled, &all, sizeof scaled);
  return scaled;
}

inline Lanes mix(Lanes a, Lanes b, float weight) noexcept { return a + weight * (b - a); }

/// Where the pairs of one batch lie: the lowest corner's number in memory, and the weight of the higher neighbour on each axis.
struct Cells {
  std::array<std::uint32_t, batch> node;
  std::array<std::array<float, batch>, 3> weight;
};

struct AxisView {
  AxisEnd end;
  float count;           ///< of nodes
  std::uint32_t stride;  ///< in nodes of the memory
};

/// What lies on the axis, from 0 up to the last node (clamped) or below `count` (periodic); NaN stays NaN. Truncation stands for the
/// floor, which not every instruction set has: the numbers are small and, where it matters, not negative.
inline float on_axis(float x, float last) noexcept {
  x = x < 0.0f ? 0.0f : x;
  return x > last ? last : x;
}
inline float on_circle(float x, float count) noexcept {
  const float turns = x / count, some = turns < 0x1p24f ? turns : 0x1p24f, safe = some > -0x1p24f ? some : -0x1p24f;
  x -= static_cast<float>(static_cast<std::int32_t>(safe)) * count;
  x = x < 0.0f ? x + count : x;
  x = x < 0.0f ? 0.0f : x;  // too far away to be counted in turns
  return x >= count ? 0.0f : x;
}
/// As an index; NaN, which a cast must not meet, is 0.
inline std::int32_t whole(float x) noexcept { return static_cast<std::int32_t>(x >= 0.0f ? x : 0.0f); }

/// `nearest` moves a pair to the nearest node and leaves no weight that is used.
GONIO_MULTIVERSION void find_cells(const AxisView axis, const float* __restrict position, std::size_t count, bool nearest,
                                   std::uint32_t* __restrict node, float* __restrict weight) noexcept {
  const float last = axis.count - 1.0f, shift = nearest ? 0.5f : 0.0f;
  if (axis.end == AxisEnd::periodic) {
    for (std::size_t k = 0; k < count; ++k) {
      const float x = on_circle(position[k] + shift, axis.count);
      const std::int32_t low = whole(x);
      weight[k] = x - static_cast<float>(low);
      node[k] += static_cast<std::uint32_t>(low) * axis.stride;
    }
    return;
  }
  // The last node has no neighbour: it is the higher one of the cell before it.
  const auto highest = static_cast<std::int32_t>(nearest ? last : last - 1.0f);
  for (std::size_t k = 0; k < count; ++k) {
    const float x = on_axis(position[k] + shift, last);
    const std::int32_t low = whole(x) < highest ? whole(x) : highest;
    weight[k] = x - static_cast<float>(low);
    node[k] += static_cast<std::uint32_t>(low) * axis.stride;
  }
}

/// What a lookup reads: numbers in memory, with lane_count more behind the last.
template <class T>
struct Memory {
  const T* first;
  std::size_t channels;
  std::array<std::size_t, 3> stride;  ///< in elements
};

template <std::size_t fixed_channels, class T>
void read_nearest(const Memory<T>& memory, const Cells& cells, std::size_t count, float* out) noexcept {
  const std::size_t channels = fixed_channels ? fixed_channels : memory.channels;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < channels; c += lane_count) {
      const Lanes value = load(memory.first + cells.node[k] * channels + c);
      std::memcpy(out + k * channels + c, &value, std::min(lane_count, channels - c) * sizeof(float));
    }
}

template <std::size_t fixed_channels, class T>
void read_linear(const Memory<T>& memory, const Cells& cells, std::size_t count, float* out) noexcept {
  const std::size_t channels = fixed_channels ? fixed_channels : memory.channels;
  const std::size_t sx = memory.stride[0], sy = memory.stride[1], sz = memory.stride[2];
  for (std::size_t k = 0; k < count; ++k) {
    const float wx = cells.weight[0][k], wy = cells.weight[1][k], wz = cells.weight[2][k];
    for (std::size_t c = 0; c < channels; c += lane_count) {
      const T* const at = memory.first + cells.node[k] * channels + c;
      const auto row = [&](const T* from) { return mix(load(from), load(from + sz), wz); };
      const Lanes value = mix(mix(row(at), row(at + sy), wy), mix(row(at + sx), row(at + sx + sy), wy), wx);
      std::memcpy(out + k * channels + c, &value, std::min(lane_count, channels - c) * sizeof(float));
    }
  }
}

template <class T>
void read(const Memory<T>& memory, const Cells& cells, std::size_t count, Interpolation interpolation, float* out) noexcept {
  const bool linear = interpolation == Interpolation::linear;
  if (memory.channels == 3)
    linear ? read_linear<3>(memory, cells, count, out) : read_nearest<3>(memory, cells, count, out);
  else
    linear ? read_linear<0>(memory, cells, count, out) : read_nearest<0>(memory, cells, count, out);
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
    memory.resize(numbers + lane_count);
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
  Cells cells;
  for (std::size_t first = 0; first < n; first += batch) {
    const std::size_t count = std::min(batch, n - first);
    std::fill_n(cells.node.begin(), count, 0u);
    for (std::size_t a = 0; a < 3; ++a)
      find_cells({shape_.end[a], static_cast<float>(shape_.count[a]), static_cast<std::uint32_t>(stride[a])}, at.axis[a].data() + first,
                 count, interpolation == Interpolation::nearest, cells.node.data(), cells.weight[a].data());
    float* const values = out.data() + first * channels;
    const std::array<std::size_t, 3> elements{stride[0] * channels, stride[1] * channels, stride[2] * channels};
    if (storage_ == Storage::f32)
      read(Memory<float>{f32_.data(), channels, elements}, cells, count, interpolation, values);
    else
      read(Memory<std::uint16_t>{f16_.data(), channels, elements}, cells, count, interpolation, values);
    if (interpolation == Interpolation::nearest) {
      for (std::size_t k = 0; k < count; ++k)
        if (const float sum = cells.weight[0][k] + cells.weight[1][k] + cells.weight[2][k]; sum != sum)
          std::fill_n(values + k * channels, channels, unknown);
      continue;
    }
    // A NaN has come from a node that is not known, the others of that cell may be; or from a coordinate.
    for (std::size_t k = 0; k < count; ++k) {
      bool whole = true;
      for (std::size_t c = 0; c < channels; ++c) whole &= values[k * channels + c] == values[k * channels + c];
      if (!whole) known_mean({at.axis[0][first + k], at.axis[1][first + k], at.axis[2][first + k]}, {values + k * channels, channels});
    }
  }
}

std::array<LookupGrid::Corner, 8> LookupGrid::corners(std::array<float, 3> position) const noexcept {
  std::array<Corner, 8> out;
  out.fill({0, 1});
  for (std::size_t a = 0; a < 3; ++a) {
    const auto nodes = static_cast<float>(shape_.count[a]);
    const bool circle = shape_.end[a] == AxisEnd::periodic;
    const float x = circle ? on_circle(position[a], nodes) : on_axis(position[a], nodes - 1);
    const std::int32_t low = circle ? whole(x) : std::min(whole(x), static_cast<std::int32_t>(nodes) - 2);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const bool high = (corner >> (2 - a) & 1) != 0;
      out[corner].node = out[corner].node * stored_[a] + static_cast<std::size_t>(low) + (high ? 1 : 0);
      const float weight = x - static_cast<float>(low);
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
    for (std::size_t a = 0; a < 3; ++a) {
      const auto nodes = static_cast<float>(shape_.count[a]);
      const float x = position[a] + 0.5f;
      const float on = shape_.end[a] == AxisEnd::periodic ? on_circle(x, nodes) : on_axis(x, nodes - 1);
      node = node * stored_[a] + static_cast<std::size_t>(whole(on));
    }
    for (std::size_t c = 0; c < shape_.channels; ++c) out[c] = value(node, c);
    return;
  }
  std::array<float, 3> weight{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto nodes = static_cast<float>(shape_.count[a]);
    const bool circle = shape_.end[a] == AxisEnd::periodic;
    const float x = circle ? on_circle(position[a], nodes) : on_axis(position[a], nodes - 1);
    weight[a] = x - (circle ? std::trunc(x) : std::min(std::trunc(x), nodes - 2));  // as a number: the batch counts in integers
  }
  const std::array<Corner, 8> corner = corners(position);
  bool whole = true;
  for (std::size_t c = 0; c < shape_.channels; ++c) {
    std::array<float, 8> v;
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = value(corner[k].node, c);
    const auto between = [](float a, float b, float w) { return a + w * (b - a); };
    for (std::size_t k = 0; k < 4; ++k) v[k] = between(v[2 * k], v[2 * k + 1], weight[2]);
    for (std::size_t k = 0; k < 2; ++k) v[k] = between(v[2 * k], v[2 * k + 1], weight[1]);
    out[c] = between(v[0], v[1], weight[0]);
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
