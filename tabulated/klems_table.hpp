// SPDX-License-Identifier: BSD-3-Clause
// A BSDF as a matrix over pairs of Klems' patches.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"
#include "tabulated/formats/sheet_side.hpp"
#include "tabulated/klems_basis.hpp"

namespace gonio::tabulated {

/// Piecewise constant: the mean over a pair of patches is the value at every pair of directions in them, as Radiance reads such files
/// (which also shakes each value by up to 3e-4 of it; not done here). The incident patch is found from the *opposite* azimuth of wi, so
/// that mirror pairs have equal numbers.
class KlemsTable final : public Brdf {
 public:
  /// values[channel][out · incident.size() + in] in 1/sr, cosine not included; NaN where nothing is known.
  KlemsTable(KlemsBasis incident, KlemsBasis outgoing, SheetSide side, Channels channels, std::vector<std::vector<double>> values);

  const KlemsBasis& incident() const noexcept { return incident_; }
  const KlemsBasis& outgoing() const noexcept { return outgoing_; }
  const SheetSide& side() const noexcept { return side_; }
  double value(std::size_t channel, std::size_t in, std::size_t out) const { return values_[channel][out * incident_.size() + in]; }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  using Brdf::eval;
  /// 0 where the pair lies on other sides of the sheet than the table is about; NaN beyond the last ring.
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

  /// One sample per pair of patches that is known, at the centres of the patches.
  Dataset samples() const;
  /// The reflected (or transmitted) part of light from a patch: Σ value · projected solid angle; unknown values are left out.
  double hemispherical(std::size_t channel, std::size_t in) const;

 private:
  KlemsBasis incident_, outgoing_;
  SheetSide side_;
  Channels channels_;
  std::vector<std::vector<double>> values_;
};

}  // namespace gonio::tabulated
