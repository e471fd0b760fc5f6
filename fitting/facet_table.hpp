// SPDX-License-Identifier: BSD-3-Clause
// A large table as a microfacet lobe needs it: four numbers of geometry a sample in float, summed into normal equations in double.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "brdf/observations.hpp"
#include "fitting/linear_part.hpp"
#include "fitting/not_fitted.hpp"
#include "fitting/variance_model.hpp"

namespace gonio::fitting {

/// Samples of a model f = ρd/π + lobe(tan² θh, cos θi, cos θo; α) (F0 (1 - w) + F90 w), w = (1 - cos θd)^5 (GGX with Schlick's
/// reflectance): isotropic, one nonlinear parameter, and the lobe from three cosines alone, so that it runs in float over many samples at
/// once. The basis is good to 1e-6 of itself, at random, and every sum is taken in double: over a million samples the cost keeps the
/// digits that a 95 % interval needs.
class FacetTable {
 public:
  /// The table, or null if the model has no such lobe, a channel misses a value that another one has, or there is nothing in it.
  /// The samples are those that `make_terms` would use under the linear metric; `threads` read them.
  static std::unique_ptr<FacetTable> of(const Observations& observations, const ModelKernel& kernel, int threads);

  std::size_t rows() const noexcept { return rows_; }
  std::size_t channels() const noexcept { return channels_; }
  const NotFitted& not_fitted() const noexcept { return not_fitted_; }
  /// Every `stride`-th sample of every block. The numbers of the samples in their blocks: `samples(block)`.
  FacetTable every(std::size_t stride, int threads) const;
  const std::vector<std::uint32_t>& samples(std::size_t block) const { return pieces_[block].sample; }
  /// Values of a channel in the order of `samples` [1/sr].
  std::span<const float> values(std::size_t block, std::size_t channel) const;

  /// Weights 1/σ² of a variance model per channel at the fitted values; `linear`: [channel][3].
  void weigh(const std::vector<VarianceModel>& variance, const std::vector<std::vector<double>>& linear, double alpha, int threads);

  /// The upper triangles, packed by columns, of the symmetric matrices Σ weight v vᵀ with v = (1/π, lobe (1 - w), lobe w, f), one per
  /// channel after another: `sums_per_channel` numbers each. The result does not depend on the number of threads.
  static constexpr std::size_t sums_per_channel = 10;
  std::vector<double> sums(double alpha, int threads) const;

  using LobeBatch = void (*)(const float* tan2_h, const float* cos_i, const float* cos_o, std::size_t size, float alpha, float* out);

 private:
  /// The samples of a block, column by column.
  struct Piece {
    std::vector<std::uint32_t> sample;
    std::vector<float> tan2_h, cos_i, cos_o, schlick;
    std::vector<std::vector<float>> value, weight;  ///< per channel; no weight: 1
    std::vector<std::array<double, 3>> moments;     ///< per channel: Σ weight, Σ weight f, Σ weight f²
    NotFitted not_fitted;
    void sum_values();
    bool holes = false;  ///< a channel misses a value that another one has
  };
  static Piece piece_of(const Observations& observations, std::size_t block);
  void count_rows();
  std::vector<double> sums_of(const Piece& piece, float alpha) const;

  LobeBatch lobe_ = nullptr;
  std::size_t rows_ = 0, channels_ = 0;
  NotFitted not_fitted_;
  std::vector<Piece> pieces_;
};

/// The triangles R of [basis | f], one per channel, by Cholesky's decomposition of the sums. A column that depends on those before it to
/// rounding gets an empty row.
std::vector<Matrix> triangles_of_sums(std::span<const double> sums);

}  // namespace gonio::fitting
