// SPDX-License-Identifier: BSD-3-Clause
// Symmetry that data do not have by construction, imposed by averaging, and what that changes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "brdf/coordinates.hpp"
#include "brdf/uncertain_brdf.hpp"

namespace gonio::tabulated {

/// The mean over a pair of directions and its partners: exchanged for reciprocity, mirrored at the plane of x and z for bilateral symmetry,
/// turned about the normal in 24 steps for isotropy; only for what the BRDF is not flagged to have already.
///
/// Only partners of the best coverage take part, so a masked direction takes its partner's value. Weights are 1/u² where every u is known,
/// else equal. u of the mean: as if the partners shared all of their error, for they may (Σ weight · u), and never below their own scatter
/// about the mean over sqrt(n - 1) (R. T. Birge, Phys. Rev. 40, 1932). An average of what differs is a choice, not a measurement: where
/// filling by reciprocity and filling by interpolation disagree, the truth may be neither.
class ImposedBrdf final : public UncertainBrdf {
 public:
  static constexpr int turns = 24;
  /// `uncertain` is `brdf` where it knows its uncertainty, or null: then u is NaN and every known value counts as interpolated.
  ImposedBrdf(std::shared_ptr<const Brdf> brdf, std::shared_ptr<const UncertainBrdf> uncertain, Symmetry imposed);

  const Channels& channels() const override { return brdf_->channels(); }
  Symmetry symmetry() const override;
  std::optional<std::vector<double>> delta() const override { return brdf_->delta(); }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;
  void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                             std::span<Coverage> coverage) const override;

 private:
  std::shared_ptr<const Brdf> brdf_;
  std::shared_ptr<const UncertainBrdf> uncertain_;
  Symmetry imposed_;
};

/// |ln(after/before)| over values that are positive before and after, all channels.
struct SymmetryChange {
  std::size_t n = 0;           ///< values compared
  std::size_t n_changed = 0;   ///< by more than rounding
  std::size_t n_left_out = 0;  ///< not positive, or unknown
  double mean = 0, p95 = 0, largest = 0;
  GonioAngles largest_at;
};

/// `before` has n · C values of f [1/sr] at the n pairs; NaN where there is none.
SymmetryChange symmetry_change(std::span<const GonioAngles> pairs, std::span<const double> before, const Brdf& after);

}  // namespace gonio::tabulated
