// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/facet_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstring>
#include <numbers>

#include "brdf/models.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t at_once = 256;  // samples whose lobe and basis stay in the first-level cache
constexpr double inv_pi = std::numbers::inv_pi;

template <class M>
concept FacetModel = AnalyticModel<M> && linear_count<M>()
== 3 && nonlinear_count<M>() == 1 && M::parameters[1].name == "f0" && M::parameters[2].name == "f90" && requires(float x) {
  { M::lobe(x, x, x, x) } -> std::same_as<float>;
};

/// Four numbers that the compiler keeps in one register, or in two where there is no AVX.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));
constexpr std::size_t four = 4;

// The loops below are compiled twice, for any x86-64 and for AVX2; without FMA, so that both round alike.

template <class M>
[[gnu::always_inline]] inline void lobes(const float* tan2_h, const float* cos_i, const float* cos_o, std::size_t size, float alpha,
                                         float* out) {
  for (std::size_t k = 0; k < size; ++k) out[k] = M::lobe(tan2_h[k], cos_i[k], cos_o[k], alpha);
}

/// lobe (1 - w) and lobe w in double.
[[gnu::always_inline]] inline void basis(const float* lobe, const float* schlick, double* b1, double* b2) {
  for (std::size_t k = 0; k < at_once; k += four) {
    FourFloats l, s;
    std::memcpy(&l, lobe + k, sizeof l);
    std::memcpy(&s, schlick + k, sizeof s);
    const Four whole = __builtin_convertvector(l, Four), second = whole * __builtin_convertvector(s, Four), first = whole - second;
    std::memcpy(b1 + k, &first, sizeof first);
    std::memcpy(b2 + k, &second, sizeof second);
  }
}

/// Adds Σ w b1, Σ w b2, Σ w b1², Σ w b1 b2, Σ w b2² to out[0..4]; `weight` null: 1.
[[gnu::always_inline]] inline void add_squares(const double* b1, const double* b2, const float* weight, double* out) {
  Four s1{}, s2{}, s11{}, s12{}, s22{};
  for (std::size_t k = 0; k < at_once; k += four) {
    Four x1, x2;
    std::memcpy(&x1, b1 + k, sizeof x1);
    std::memcpy(&x2, b2 + k, sizeof x2);
    Four w1 = x1, w2 = x2;
    if (weight != nullptr) {
      FourFloats w;
      std::memcpy(&w, weight + k, sizeof w);
      const Four wide = __builtin_convertvector(w, Four);
      w1 *= wide, w2 *= wide;
    }
    s1 += w1, s2 += w2, s11 += w1 * x1, s12 += w1 * x2, s22 += w2 * x2;
  }
  const Four all[] = {s1, s2, s11, s12, s22};
  for (std::size_t k = 0; k < 5; ++k) out[k] += (all[k][0] + all[k][1]) + (all[k][2] + all[k][3]);
}

/// Adds Σ w, Σ w f, Σ w f² to out[0..2]; `weight` null: 1. `size` is a whole number of batches.
[[gnu::always_inline]] inline void add_moments(const float* value, const float* weight, std::size_t size, double* out) {
  Four s0{}, s1{}, s2{};
  for (std::size_t k = 0; k < size; k += four) {
    FourFloats v, w{1, 1, 1, 1};
    std::memcpy(&v, value + k, sizeof v);
    if (weight != nullptr) std::memcpy(&w, weight + k, sizeof w);
    const Four f = __builtin_convertvector(v, Four), wide = __builtin_convertvector(w, Four), first = wide * f;
    s0 += wide, s1 += first, s2 += first * f;
  }
  const Four all[] = {s0, s1, s2};
  for (std::size_t k = 0; k < 3; ++k) out[k] += (all[k][0] + all[k][1]) + (all[k][2] + all[k][3]);
}

/// Adds Σ w b1 f, Σ w b2 f to out[0..1].
[[gnu::always_inline]] inline void add_products(const double* b1, const double* b2, const float* value, const float* weight, double* out) {
  Four s1{}, s2{};
  for (std::size_t k = 0; k < at_once; k += four) {
    Four x1, x2;
    FourFloats v;
    std::memcpy(&x1, b1 + k, sizeof x1);
    std::memcpy(&x2, b2 + k, sizeof x2);
    std::memcpy(&v, value + k, sizeof v);
    Four wide = __builtin_convertvector(v, Four);
    if (weight != nullptr) {
      FourFloats w;
      std::memcpy(&w, weight + k, sizeof w);
      wide *= __builtin_convertvector(w, Four);
    }
    s1 += x1 * wide, s2 += x2 * wide;
  }
  out[0] += (s1[0] + s1[1]) + (s1[2] + s1[3]);
  out[1] += (s2[0] + s2[1]) + (s2[2] + s2[3]);
}

template <class M>
void lobes_anywhere(const float* tan2_h, const float* cos_i, const float* cos_o, std::size_t size, float alpha, float* out) {
  lobes<M>(tan2_h, cos_i, cos_o, size, alpha, out);
}
void basis_anywhere(const float* lobe, const float* schlick, double* b1, double* b2) { basis(lobe, schlick, b1, b2); }
void squares_anywhere(const double* b1, const double* b2, const float* weight, double* out) { add_squares(b1, b2, weight, out); }
void products_anywhere(const double* b1, const double* b2, const float* value, const float* weight, double* out) {
  add_products(b1, b2, value, weight, out);
}

void moments_anywhere(const float* value, const float* weight, std::size_t size, double* out) { add_moments(value, weight, size, out); }

struct Loops {
  void (*basis)(const float*, const float*, double*, double*) = basis_anywhere;
  void (*squares)(const double*, const double*, const float*, double*) = squares_anywhere;
  void (*products)(const double*, const double*, const float*, const float*, double*) = products_anywhere;
  void (*moments)(const float*, const float*, std::size_t, double*) = moments_anywhere;
};

#if defined(__x86_64__)
template <class M>
[[gnu::target("avx2")]] void lobes_avx2(const float* tan2_h, const float* cos_i, const float* cos_o, std::size_t size, float alpha,
                                        float* out) {
  lobes<M>(tan2_h, cos_i, cos_o, size, alpha, out);
}
[[gnu::target("avx2")]] void basis_avx2(const float* lobe, const float* schlick, double* b1, double* b2) { basis(lobe, schlick, b1, b2); }
[[gnu::target("avx2")]] void squares_avx2(const double* b1, const double* b2, const float* weight, double* out) {
  add_squares(b1, b2, weight, out);
}
[[gnu::target("avx2")]] void moments_avx2(const float* value, const float* weight, std::size_t size, double* out) {
  add_moments(value, weight, size, out);
}
[[gnu::target("avx2")]] void products_avx2(const double* b1, const double* b2, const float* value, const float* weight, double* out) {
  add_products(b1, b2, value, weight, out);
}
bool has_avx2() { return __builtin_cpu_supports("avx2"); }
#else
bool has_avx2() { return false; }
#endif

const Loops& loops() {
  static const Loops these = [] {
    Loops out;
#if defined(__x86_64__)
    if (has_avx2()) out = {basis_avx2, squares_avx2, products_avx2, moments_avx2};
#endif
    return out;
  }();
  return these;
}

FacetTable::LobeBatch lobe_of(const ModelKernel& kernel) {
  FacetTable::LobeBatch out = nullptr;
  for_each_model([&]<AnalyticModel M>(M) {
    if constexpr (FacetModel<M>) {
      if (kernel.info->name != M::name) return;
      out = lobes_anywhere<M>;
#if defined(__x86_64__)
      if (has_avx2()) out = lobes_avx2<M>;
#endif
    }
  });
  return out;
}

/// A whole number of batches, so that the loops need no ends.
std::size_t padded(std::size_t size) { return (size + at_once - 1) / at_once * at_once; }
void pad(std::vector<float>& column, float with) { column.resize(padded(column.size()), with); }

}  // namespace

FacetTable::Piece FacetTable::piece_of(const Observations& observations, std::size_t index) {
  const ObservationBlock block = observations.block(index);
  const std::size_t channels = block.f.size();
  FacetGeometry geometry;
  observations.facet_geometry(index, geometry);
  std::vector<std::vector<double>> f(channels, std::vector<double>(block.size));
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t k = 0; k < block.size; ++k) f[c][k] = block.f[c][k];
  const bool drop_negative = block.validity == ObservationBlock::Validity::no_channel_negative;
  Piece piece;
  piece.sample.reserve(block.size);
  for (std::size_t k = 0; k < block.size; ++k) {
    std::size_t finite = 0;
    bool valid = drop_negative || block.valid(k);
    for (const std::vector<double>& column : f) {
      finite += std::isfinite(column[k]) ? 1 : 0;
      valid = valid && !(drop_negative && column[k] < 0);
    }
    if (!valid) {
      piece.not_fitted.add(Omission::marked);
    } else if (!(geometry.cos_i[k] >= 0 && geometry.cos_o[k] >= 0)) {
      piece.not_fitted.add(Omission::below_horizon);
    } else if (finite == 0) {
      piece.not_fitted.add(Omission::no_value);
    } else {
      piece.sample.push_back(static_cast<std::uint32_t>(k));
      piece.holes = piece.holes || finite < channels;
    }
  }
  const auto picked = [&](const auto& from, auto&& convert, float padding) {
    std::vector<float> out(padded(piece.sample.size()), padding);
    for (std::size_t j = 0; j < piece.sample.size(); ++j) out[j] = convert(from[piece.sample[j]]);
    return out;
  };
  const auto same = [](float value) { return value; };
  piece.tan2_h = picked(geometry.tan2_h, same, 0);
  piece.cos_i = picked(geometry.cos_i, same, 1);
  piece.cos_o = picked(geometry.cos_o, same, 1);
  piece.schlick = picked(geometry.cos_d, schlick_weight<float>, 0);
  for (const std::vector<double>& column : f)
    piece.value.push_back(picked(
        column, [](double value) { return static_cast<float>(value); }, 0));
  piece.sum_values();
  return piece;
}

void FacetTable::Piece::sum_values() {
  moments.assign(value.size(), {});
  for (std::size_t c = 0; c < value.size(); ++c) {
    loops().moments(value[c].data(), weight.empty() ? nullptr : weight[c].data(), value[c].size(), moments[c].data());
    if (weight.empty()) moments[c][0] = static_cast<double>(sample.size());  // without those it was filled up with
  }
}

std::unique_ptr<FacetTable> FacetTable::of(const Observations& observations, const ModelKernel& kernel, int threads) {
  const LobeBatch lobe = lobe_of(kernel);
  if (lobe == nullptr) return nullptr;
  auto out = std::make_unique<FacetTable>();
  out->lobe_ = lobe;
  out->channels_ = observations.channels().size();
  out->pieces_.resize(observations.block_count());
  for_each_index(out->pieces_.size(), threads, [&](std::size_t b) { out->pieces_[b] = piece_of(observations, b); });
  for (const Piece& piece : out->pieces_)
    if (piece.holes) return nullptr;
  out->count_rows();
  return out->rows_ > 0 ? std::move(out) : nullptr;
}

void FacetTable::count_rows() {
  rows_ = 0;
  not_fitted_ = {};
  for (const Piece& piece : pieces_) rows_ += piece.sample.size(), not_fitted_ += piece.not_fitted;
}

FacetTable FacetTable::every(std::size_t stride, int threads) const {
  FacetTable out;
  out.lobe_ = lobe_;
  out.channels_ = channels_;
  out.pieces_.resize(pieces_.size());
  for_each_index(pieces_.size(), threads, [&](std::size_t b) {
    const Piece& all = pieces_[b];
    Piece& some = out.pieces_[b];
    some.value.resize(channels_);
    some.not_fitted = all.not_fitted;
    // Another start in every block, or a grid would give the same places in all of them.
    for (std::size_t k = (b * 7) % stride; k < all.sample.size(); k += stride) {
      some.sample.push_back(all.sample[k]);
      some.tan2_h.push_back(all.tan2_h[k]), some.cos_i.push_back(all.cos_i[k]), some.cos_o.push_back(all.cos_o[k]);
      some.schlick.push_back(all.schlick[k]);
      for (std::size_t c = 0; c < channels_; ++c) some.value[c].push_back(all.value[c][k]);
    }
    pad(some.tan2_h, 0), pad(some.cos_i, 1), pad(some.cos_o, 1), pad(some.schlick, 0);
    for (auto& value : some.value) pad(value, 0);
    some.sum_values();
  });
  out.count_rows();
  return out;
}

std::span<const float> FacetTable::values(std::size_t block, std::size_t channel) const {
  return std::span(pieces_[block].value[channel]).first(pieces_[block].sample.size());
}

void FacetTable::weigh(const std::vector<VarianceModel>& variance, const std::vector<std::vector<double>>& linear, double alpha,
                       int threads) {
  for_each_index(pieces_.size(), threads, [&](std::size_t b) {
    Piece& piece = pieces_[b];
    const std::size_t size = piece.cos_i.size();
    std::vector<float> lobe(size);
    lobe_(piece.tan2_h.data(), piece.cos_i.data(), piece.cos_o.data(), size, static_cast<float>(alpha), lobe.data());
    piece.weight.assign(channels_, std::vector<float>(size, 0.0f));
    for (std::size_t k = 0; k < piece.sample.size(); ++k) {
      const double tan2_i = variance.front().tilt > 0 ? tan_squared(piece.cos_i[k]) : 0;
      for (std::size_t c = 0; c < channels_; ++c) {
        const double fitted = linear[c][0] * inv_pi + lobe[k] * (linear[c][1] * (1 - piece.schlick[k]) + linear[c][2] * piece.schlick[k]);
        const double sigma2 = variance[c](fitted, tan2_i);
        piece.weight[c][k] = sigma2 > 0 ? static_cast<float>(1 / sigma2) : 0.0f;
      }
    }
    piece.sum_values();
  });
}

std::vector<double> FacetTable::sums_of(const Piece& piece, float alpha) const {
  // Packed upper triangle of a channel: 00, 01, 11, 02, 12, 22, 03, 13, 23, 33 with v = (1/π, b1, b2, f).
  std::vector<double> out(channels_ * sums_per_channel, 0.0);
  alignas(64) std::array<float, at_once> lobe;
  alignas(64) std::array<double, at_once> b1, b2;
  std::array<double, 5> shared{};
  const std::size_t size = piece.sample.size();
  for (std::size_t begin = 0; begin < size; begin += at_once) {
    lobe_(piece.tan2_h.data() + begin, piece.cos_i.data() + begin, piece.cos_o.data() + begin, at_once, alpha, lobe.data());
    for (std::size_t k = std::min(at_once, size - begin); k < at_once; ++k) lobe[k] = 0;
    loops().basis(lobe.data(), piece.schlick.data() + begin, b1.data(), b2.data());
    if (piece.weight.empty()) loops().squares(b1.data(), b2.data(), nullptr, shared.data());
    for (std::size_t c = 0; c < channels_; ++c) {
      const float* const weight = piece.weight.empty() ? nullptr : piece.weight[c].data() + begin;
      const float* const value = piece.value[c].data() + begin;
      double* const sum = out.data() + c * sums_per_channel;
      std::array<double, 5> own{};
      if (weight != nullptr) {
        loops().squares(b1.data(), b2.data(), weight, own.data());
        sum[1] += inv_pi * own[0], sum[2] += own[2], sum[3] += inv_pi * own[1], sum[4] += own[3], sum[5] += own[4];
      }
      std::array<double, 2> product{};
      loops().products(b1.data(), b2.data(), value, weight, product.data());
      sum[7] += product[0], sum[8] += product[1];
    }
  }
  for (std::size_t c = 0; c < channels_; ++c) {
    double* const sum = out.data() + c * sums_per_channel;
    const auto [count, first, second] = piece.moments[c];
    sum[0] = inv_pi * inv_pi * count, sum[6] = inv_pi * first, sum[9] = second;
    if (piece.weight.empty())
      sum[1] = inv_pi * shared[0], sum[2] = shared[2], sum[3] = inv_pi * shared[1], sum[4] = shared[3], sum[5] = shared[4];
  }
  return out;
}

std::vector<double> FacetTable::sums(double alpha, int threads) const {
  std::vector<std::vector<double>> parts(pieces_.size());
  for_each_index(pieces_.size(), threads, [&](std::size_t b) { parts[b] = sums_of(pieces_[b], static_cast<float>(alpha)); });
  std::vector<double> out(channels_ * sums_per_channel, 0.0);
  for (const auto& part : parts)
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += part[k];
  return out;
}

std::vector<Matrix> triangles_of_sums(std::span<const double> sums) {
  constexpr std::size_t n = 4;
  constexpr double dependent = 1e-13;  // part of a column's square that is left after the others: rounding
  std::vector<Matrix> out;
  for (std::size_t first = 0; first < sums.size(); first += FacetTable::sums_per_channel) {
    Matrix r(n, n);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        double rest = sums[first + j * (j + 1) / 2 + i];
        const double whole = rest;
        for (std::size_t k = 0; k < i; ++k) rest -= r(k, i) * r(k, j);
        if (i == j)
          r(j, j) = rest > dependent * whole ? std::sqrt(rest) : 0;
        else
          r(i, j) = r(i, i) > 0 ? rest / r(i, i) : 0;
      }
    out.push_back(std::move(r));
  }
  return out;
}

}  // namespace gonio::fitting
