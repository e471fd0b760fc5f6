// SPDX-License-Identifier: BSD-3-Clause
// A table of measured samples that takes the shape between them from a model.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "brdf/dataset.hpp"
#include "brdf/uncertain_brdf.hpp"
#include "tabulated/guided_samples.hpp"
#include "tabulated/interpolation_error.hpp"
#include "tabulated/neighbourhood.hpp"

namespace gonio::tabulated {

struct GuidedTableOptions {
  bool extrapolate = true;  ///< else NaN beyond the samples and in masked regions
  int threads = 2;          ///< of the preparation
};

/// Interpolates what is left of the samples when a guide is taken away (GuidedSamples: their ratio to it, or their difference where it
/// vanishes) and puts the guide back. A peak that lies between samples is kept as far as the guide knows it.
///
/// Interpolation: ordinary kriging of the nearest samples, without a nugget, in the coordinates of `pair_point`; ranges and error from the
/// samples themselves (InterpolationError). Exact at samples: a measured value is handed on unchanged (repeats, and samples that the
/// symmetry makes one, as their weighted mean), with its own u. Between samples continuous but for steps, small against u, where the set
/// of neighbours changes; the rest stays within the range of the neighbours' rests, and f is not below 0 where theirs is not.
///
/// u² = noise of the samples through the weights + error of interpolation + Σ over the correlated components of their part, which is common
/// to the neighbours and added along before it is squared. Samples of unknown u are NaN themselves; between them u rests on the noise that
/// the misses of left-out samples show, which holds no common error.
///
/// Extrapolated are pairs beyond the convex hull of their neighbours, those nearer to a masked direction (a row without any value) than to
/// a sample, and those farther from every sample than samples there are from each other. They hold the rest within the range of the
/// neighbours at the edge, and are scaled down where the directional albedo would pass 1 with them (EnergyBound). A guess, however
/// bounded: nothing was measured there.
class GuidedTable final : public UncertainBrdf {
 public:
  /// `guide` may be null: plain interpolation of f. Masked directions are rows of `samples` without any value. Throws as guided_samples.
  GuidedTable(std::shared_ptr<const Dataset> samples, std::shared_ptr<const Brdf> guide, const GuidedTableOptions& options = {});
  /// Of what was made of the same samples and guide before.
  GuidedTable(std::shared_ptr<const Dataset> samples, std::shared_ptr<const Brdf> guide, GuidedSamples guided, InterpolationError error,
              const GuidedTableOptions& options);
  ~GuidedTable() override;

  const Channels& channels() const override { return dataset_->channels; }
  Symmetry symmetry() const override { return dataset_->symmetry; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;
  /// As UncertainBrdf says; u and coverage may be empty: then they are not found.
  void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                             std::span<Coverage> coverage) const override;

  const GuidedSamples& samples() const { return samples_; }
  const InterpolationError& error() const { return error_; }
  /// What extrapolated values are multiplied by, per channel; 1 where energy is no matter.
  std::vector<double> energy_scale(const Direction& wi) const;

 private:
  class EnergyBound;
  struct Scratch;
  Coverage eval_pair(const Direction& wi, const Direction& wo, const double* guide, bool bounded, double* f, double* u,
                     Scratch& scratch) const;
  void eval_all(std::span<const Direction> wi, std::span<const Direction> wo, bool bounded, std::span<double> f, std::span<double> u,
                std::span<Coverage> coverage) const;
  const EnergyBound& energy_bound() const;

  std::shared_ptr<const Dataset> dataset_;
  std::shared_ptr<const Brdf> guide_;
  GuidedTableOptions options_;
  GuidedSamples samples_;
  InterpolationError error_;
  Neighbourhoods neighbourhoods_;
  mutable std::once_flag energy_once_;
  mutable std::unique_ptr<const EnergyBound> energy_;
};

}  // namespace gonio::tabulated
