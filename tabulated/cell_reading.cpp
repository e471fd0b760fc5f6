// SPDX-License-Identifier: BSD-3-Clause
// Built without contraction of products and sums (see CMakeLists.txt), so that every instruction set gives the same bits.
#include "tabulated/cell_reading.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "tabulated/multiversion.hpp"
#ifdef GONIO_AVX2
#include <immintrin.h>
#endif

namespace gonio::tabulated {
namespace {

/// Floats in one register: the channels of a node, and whatever lies behind them.
typedef float Lanes __attribute__((vector_size(16)));
typedef float WideLanes __attribute__((vector_size(32)));
typedef std::uint32_t BitLanes __attribute__((vector_size(16)));
typedef std::uint16_t HalfLanes __attribute__((vector_size(8)));
constexpr std::size_t lane_count = 4;

/// The bits of a half in a float's place are the number times 2^-112; what had the largest exponent (NaN) becomes 2^16 and more.
inline Lanes converted(HalfLanes halfs) noexcept {
  const BitLanes bits = __builtin_convertvector(halfs, BitLanes);
  const BitLanes magnitude = (bits & 0x7fffu) << 13, sign = (bits & 0x8000u) << 16;
  const Lanes scaled = reinterpret_cast<Lanes>(magnitude) * 0x1p112f;
  const BitLanes is_nan = reinterpret_cast<BitLanes>(scaled >= 65536.0f) & 0x7fc00000u;
  return reinterpret_cast<Lanes>(reinterpret_cast<BitLanes>(scaled) | sign | is_nan);
}

/// Vectors of any width from memory. Results by reference: how a wide vector is returned depends on the instruction set.
struct PortableLoad {
  template <class Vector>
  static inline void load(Vector& out, const float* from) noexcept {
    std::memcpy(&out, from, sizeof out);
  }
  static inline void load(Lanes& out, const std::uint16_t* from) noexcept {
    HalfLanes halfs;
    std::memcpy(&halfs, from, sizeof halfs);
    out = converted(halfs);
  }
  static inline void load(WideLanes& out, const std::uint16_t* from) noexcept {
    Lanes low, high;
    load(low, from), load(high, from + lane_count);
    out = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
};

inline void mix(auto& a, const auto& b, float weight) noexcept { a = a + weight * (b - a); }

/// The first `count` lanes. All four where more values of the same output follow, which then overwrite what is too much.
inline void store(float* out, const Lanes& value, std::size_t count, bool more_follow) noexcept {
  std::memcpy(out, &value, more_follow ? sizeof value : count * sizeof(float));
}

template <class Load, std::size_t fixed_channels, class T>
inline void nearest(const NodeMemory<T>& memory, const Cells& cells, float* __restrict out) noexcept {
  const std::size_t channels = fixed_channels ? fixed_channels : memory.channels;
  for (std::size_t k = 0; k < cells.count; ++k)
    for (std::size_t c = 0; c < channels; c += lane_count) {
      Lanes value;
      Load::load(value, memory.first + cells.node[k] * channels + c);
      store(out + k * channels + c, value, std::min(lane_count, channels - c), fixed_channels == 3 && k + 1 < cells.count);
    }
}

/// The two nodes next to each other on the last axis come in one vector.
template <class Load, std::size_t channels, class T>
inline bool linear_in_pairs(const NodeMemory<T>& memory, const Cells& cells, float* __restrict out) noexcept {
  using Pair = std::conditional_t<channels == 1, Lanes, WideLanes>;
  const std::size_t sx = memory.stride[0] * channels, sy = memory.stride[1] * channels;
  BitLanes unknown{};
  for (std::size_t k = 0; k < cells.count; ++k) {
    const T* const at = memory.first + cells.node[k] * channels;
    const float wx = cells.weight[0][k];
    Pair low, low_x, high, high_x;
    Load::load(low, at), Load::load(low_x, at + sx), Load::load(high, at + sy), Load::load(high_x, at + sx + sy);
    mix(low, low_x, wx), mix(high, high_x, wx), mix(low, high, cells.weight[1][k]);
    Lanes value, next;
    if constexpr (channels == 1)
      value = low, next = __builtin_shufflevector(low, low, 1, 1, 1, 1);
    else
      value = __builtin_shufflevector(low, low, 0, 1, 2, 3), next = __builtin_shufflevector(low, low, 3, 4, 5, 6);
    mix(value, next, cells.weight[2][k]);
    unknown |= reinterpret_cast<BitLanes>(value != value);
    store(out + k * channels, value, channels, channels == 3 && k + 1 < cells.count);
  }
  std::uint32_t any = 0;
  for (std::size_t c = 0; c < channels; ++c) any |= unknown[c];
  return any != 0;
}

template <class Load, class T>
inline bool linear(const NodeMemory<T>& memory, const Cells& cells, float* __restrict out) noexcept {
  const std::size_t channels = memory.channels;
  const std::size_t sx = memory.stride[0] * channels, sy = memory.stride[1] * channels, sz = memory.stride[2] * channels;
  bool unknown = false;
  for (std::size_t k = 0; k < cells.count; ++k)
    for (std::size_t c = 0; c < channels; c += lane_count) {
      const T* const at = memory.first + cells.node[k] * channels + c;
      const auto face = [&](Lanes& low, const T* from) {
        Lanes low_x, high, high_x;
        Load::load(low, from), Load::load(low_x, from + sx), Load::load(high, from + sy), Load::load(high_x, from + sx + sy);
        mix(low, low_x, cells.weight[0][k]), mix(high, high_x, cells.weight[0][k]), mix(low, high, cells.weight[1][k]);
      };
      Lanes value, next;
      face(value, at), face(next, at + sz);
      mix(value, next, cells.weight[2][k]);
      const std::size_t count = std::min(lane_count, channels - c);
      for (std::size_t lane = 0; lane < count; ++lane) unknown |= value[lane] != value[lane];
      store(out + k * channels + c, value, count, false);
    }
  return unknown;
}

/// Where there is a NaN, the mean of the corners that are known, by their weights; the same sums as LookupGrid::at.
template <class T>
void fill_known_means(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
  const std::size_t channels = memory.channels;
  for (std::size_t k = 0; k < cells.count; ++k) {
    bool known = true;
    for (std::size_t c = 0; c < channels; ++c) known &= out[k * channels + c] == out[k * channels + c];
    if (known) continue;
    for (std::size_t c = 0; c < channels; c += lane_count) {
      Lanes sum{}, weights{};
      for (unsigned corner = 0; corner < 8; ++corner) {
        std::size_t node = cells.node[k];
        float weight = 1;
        for (unsigned axis = 0; axis < 3; ++axis) {
          const bool high = (corner >> (2 - axis) & 1) != 0;
          node += high ? memory.stride[axis] : 0;
          weight *= high ? cells.weight[axis][k] : 1 - cells.weight[axis][k];
        }
        Lanes value;
        PortableLoad::load(value, memory.first + node * channels + c);
        const Lanes all_weights = Lanes{} + (weight > 0 ? weight : 0);
        const auto is_known = value == value;
        sum += is_known ? all_weights * value : Lanes{};
        weights += is_known ? all_weights : Lanes{};
      }
      const Lanes mean = sum / weights;  // 0/0 where nothing is known
      std::memcpy(out + k * channels + c, &mean, std::min(lane_count, channels - c) * sizeof(float));
    }
  }
}

template <class Load, class T>
inline void nearest_of_any(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
  if (memory.channels == 3)
    nearest<Load, 3>(memory, cells, out);
  else if (memory.channels == 1)
    nearest<Load, 1>(memory, cells, out);
  else
    nearest<Load, 0>(memory, cells, out);
}

template <class Load, class T>
inline bool linear_of_any(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
  return memory.channels == 3   ? linear_in_pairs<Load, 3>(memory, cells, out)
         : memory.channels == 1 ? linear_in_pairs<Load, 1>(memory, cells, out)
                                : linear<Load>(memory, cells, out);
}

#ifdef GONIO_AVX2
/// Halfs by the instruction for it.
struct Avx2Load : PortableLoad {
  using PortableLoad::load;
  GONIO_AVX2 static inline void load(Lanes& out, const std::uint16_t* from) noexcept {
    out = _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
  }
  GONIO_AVX2 static inline void load(WideLanes& out, const std::uint16_t* from) noexcept {
    out = _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  }
};

template <class T>
GONIO_AVX2 [[gnu::flatten]] void nearest_avx2(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
  nearest_of_any<Avx2Load>(memory, cells, out);
}
template <class T>
GONIO_AVX2 [[gnu::flatten]] bool linear_avx2(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
  return linear_of_any<Avx2Load>(memory, cells, out);
}
#endif

}  // namespace

template <class T>
void read_nearest(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
#ifdef GONIO_AVX2
  if (has_avx2()) return nearest_avx2(memory, cells, out);
#endif
  nearest_of_any<PortableLoad>(memory, cells, out);
}

template <class T>
void read_linear(const NodeMemory<T>& memory, const Cells& cells, float* out) noexcept {
#ifdef GONIO_AVX2
  const bool unknown = has_avx2() ? linear_avx2(memory, cells, out) : linear_of_any<PortableLoad>(memory, cells, out);
#else
  const bool unknown = linear_of_any<PortableLoad>(memory, cells, out);
#endif
  if (unknown) fill_known_means(memory, cells, out);
}

template void read_nearest(const NodeMemory<float>&, const Cells&, float*) noexcept;
template void read_nearest(const NodeMemory<std::uint16_t>&, const Cells&, float*) noexcept;
template void read_linear(const NodeMemory<float>&, const Cells&, float*) noexcept;
template void read_linear(const NodeMemory<std::uint16_t>&, const Cells&, float*) noexcept;

}  // namespace gonio::tabulated
