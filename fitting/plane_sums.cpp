// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/plane_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace gonio::fitting {
namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t stretch = 512;  // 4 kB a plane: the second look at a stretch finds it in the first-level cache
constexpr std::size_t first_few = 64;
constexpr double largest = std::numeric_limits<double>::max();

/// Four numbers that the compiler keeps in one register, or in two where there is no AVX.
using Four = double __attribute__((vector_size(32)));
/// Four answers, all bits set for yes.
using FourBits = std::int64_t __attribute__((vector_size(32)));
constexpr std::size_t four = 4;

double number_at(const std::byte* plane, std::size_t k) noexcept {
  double value;
  std::memcpy(&value, plane + k * sizeof value, sizeof value);
  return value;
}

/// Running sums of one plane about `shift`.
struct Running {
  double shift = 0;
  std::array<double, lanes> sum{}, square{}, least, most;
  std::array<std::int64_t, lanes> count{};  ///< counted down: a yes is -1
};

template <class T>
T total(const std::array<T, lanes>& of) noexcept {
  return ((of[0] + of[4]) + (of[1] + of[5])) + ((of[2] + of[6]) + (of[3] + of[7]));
}

// The two loops below are compiled twice, for any x86-64 and for AVX2; without FMA, so that both round alike.

/// Answers no for every sample with a negative number in this plane.
[[gnu::always_inline]] inline void clear_negative(const std::byte* plane, std::size_t size, std::int64_t* valid) {
  for (std::size_t k = 0; k < size; ++k) {
    double value;
    std::memcpy(&value, plane + k * sizeof value, sizeof value);
    valid[k] = value < 0 ? 0 : valid[k];
  }
}

/// `size` is a multiple of `lanes`.
[[gnu::always_inline]] inline void add_stretch(const std::byte* plane, std::size_t size, const std::int64_t* valid, Running& to) {
  const double s = to.shift;
  const Four shift{s, s, s, s}, limit{largest, largest, largest, largest};
  for (std::size_t r = 0; r < 2; ++r) {
    const std::size_t lane = r * four;
    Four sum, square, least, most;
    FourBits count;
    std::memcpy(&sum, &to.sum[lane], sizeof sum);
    std::memcpy(&square, &to.square[lane], sizeof square);
    std::memcpy(&least, &to.least[lane], sizeof least);
    std::memcpy(&most, &to.most[lane], sizeof most);
    std::memcpy(&count, &to.count[lane], sizeof count);
    for (std::size_t k = lane; k < size; k += lanes) {
      Four value;
      FourBits ok;
      std::memcpy(&value, plane + k * sizeof(double), sizeof value);
      std::memcpy(&ok, valid + k, sizeof ok);
      ok &= (value <= limit) & (value >= -limit);
      const Four used = ok ? value : shift;
      const Four d = used - shift;
      count += ok;
      sum += d;
      square += d * d;
      least = used < least ? used : least;
      most = used > most ? used : most;
    }
    std::memcpy(&to.sum[lane], &sum, sizeof sum);
    std::memcpy(&to.square[lane], &square, sizeof square);
    std::memcpy(&to.least[lane], &least, sizeof least);
    std::memcpy(&to.most[lane], &most, sizeof most);
    std::memcpy(&to.count[lane], &count, sizeof count);
  }
}

struct Loops {
  void (*clear_negative)(const std::byte*, std::size_t, std::int64_t*);
  void (*add_stretch)(const std::byte*, std::size_t, const std::int64_t*, Running&);
};

void clear_negative_anywhere(const std::byte* plane, std::size_t size, std::int64_t* valid) { clear_negative(plane, size, valid); }
void add_stretch_anywhere(const std::byte* plane, std::size_t size, const std::int64_t* valid, Running& to) {
  add_stretch(plane, size, valid, to);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void clear_negative_avx2(const std::byte* plane, std::size_t size, std::int64_t* valid) {
  clear_negative(plane, size, valid);
}
[[gnu::target("avx2")]] void add_stretch_avx2(const std::byte* plane, std::size_t size, const std::int64_t* valid, Running& to) {
  add_stretch(plane, size, valid, to);
}
#endif

Loops loops_of_this_machine() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return {clear_negative_avx2, add_stretch_avx2};
#endif
  return {clear_negative_anywhere, add_stretch_anywhere};
}

bool sample_valid(std::span<const std::byte* const> planes, std::size_t k) {
  return std::none_of(planes.begin(), planes.end(), [&](const std::byte* plane) { return number_at(plane, k) < 0; });
}

/// The mean of the first values of each plane: near enough to the mean of all that their squares do not cancel.
std::vector<Running> started(std::span<const std::byte* const> planes, std::size_t size, bool drop_negative) {
  std::vector<Running> out(planes.size());
  std::size_t found = 0;
  std::vector<double> sum(planes.size(), 0.0), count(planes.size(), 0.0);
  for (std::size_t k = 0; k < size && found < first_few; ++k) {
    if (drop_negative && !sample_valid(planes, k)) continue;
    ++found;
    for (std::size_t c = 0; c < planes.size(); ++c)
      if (const double value = number_at(planes[c], k); std::isfinite(value)) sum[c] += value, count[c] += 1;
  }
  for (std::size_t c = 0; c < planes.size(); ++c) {
    out[c].shift = count[c] > 0 ? sum[c] / count[c] : 0;
    constexpr double inf = std::numeric_limits<double>::infinity();
    out[c].least.fill(inf);
    out[c].most.fill(-inf);
  }
  return out;
}

PlaneSums finished(const Running& running) {
  PlaneSums out;
  out.count = -static_cast<double>(total(running.count));
  if (!(out.count > 0)) return out;
  const double sum = total(running.sum);
  out.mean = running.shift + sum / out.count;
  out.within = std::max(0.0, total(running.square) - sum * (sum / out.count));
  out.least = *std::min_element(running.least.begin(), running.least.end());
  out.most = *std::max_element(running.most.begin(), running.most.end());
  return out;
}

}  // namespace

SummedPlanes sum_planes(std::span<const std::byte* const> planes, std::size_t size, bool drop_negative) {
  static const Loops loops = loops_of_this_machine();
  std::vector<Running> running = started(planes, size, drop_negative);
  std::array<std::int64_t, stretch> valid;
  SummedPlanes out;
  for (std::size_t begin = 0; begin < size; begin += stretch) {
    const std::size_t count = std::min(stretch, size - begin), whole = count / lanes * lanes, rest = count - whole;
    valid.fill(-1);
    if (drop_negative)
      for (const std::byte* plane : planes) loops.clear_negative(plane + begin * sizeof(double), count, valid.data());
    std::int64_t samples = 0;
    for (std::size_t k = 0; k < count; ++k) samples -= valid[k];
    bool all_used = true;
    for (std::size_t c = 0; c < planes.size(); ++c) {
      const std::int64_t before = total(running[c].count);
      loops.add_stretch(planes[c] + begin * sizeof(double), whole, valid.data(), running[c]);
      if (rest > 0) {
        // The rest of a block that is no multiple of the lanes, filled up with what does not count.
        std::array<double, lanes> last{};
        std::array<std::int64_t, lanes> last_valid{};
        std::memcpy(last.data(), planes[c] + (begin + whole) * sizeof(double), rest * sizeof(double));
        std::copy_n(valid.begin() + static_cast<std::ptrdiff_t>(whole), rest, last_valid.begin());
        loops.add_stretch(reinterpret_cast<const std::byte*>(last.data()), lanes, last_valid.data(), running[c]);
      }
      all_used = all_used && before - total(running[c].count) == samples;
    }
    if (all_used) {
      out.used += static_cast<std::size_t>(samples);
      out.negative += count - static_cast<std::size_t>(samples);
      continue;
    }
    // Some plane has a NaN or an infinity here.
    for (std::size_t k = begin; k < begin + count; ++k) {
      std::size_t finite = 0;
      for (const std::byte* plane : planes) finite += std::isfinite(number_at(plane, k)) ? 1 : 0;
      const bool valid_sample = valid[k - begin] != 0;
      out.used += valid_sample && finite > 0;
      out.negative += !valid_sample;
      out.unknown += valid_sample && finite < planes.size();
    }
  }
  for (const Running& one : running) out.plane.push_back(finished(one));
  return out;
}

}  // namespace gonio::fitting
