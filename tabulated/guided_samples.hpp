// SPDX-License-Identifier: BSD-3-Clause
// Samples held against a guide: what is left over, at every place that the symmetry of the data gives it.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"
#include "tabulated/neighbour_tree.hpp"
#include "tabulated/sample_spacing.hpp"

namespace gonio::tabulated {

/// One sample, or the mean of those that the symmetry of the data makes one: repeats, and partners by isotropy, bilateral symmetry or
/// reciprocity. Weights 1/u² where every u is known, else equal. u of a mean is the larger of what the u say and what the samples differ
/// by (R. T. Birge, "The calculation of errors by the method of least squares", Phys. Rev. 40, 1932).
struct MeanSamples {
  std::vector<std::size_t> incidence;                    ///< [mean] of its first sample
  std::vector<std::vector<double>> f, u;                 ///< [channel][mean] 1/sr, independent; NaN: no value, u unknown
  std::vector<std::vector<std::vector<double>>> shared;  ///< [component][channel][mean] f · sensitivity · u(component) [1/sr]
  std::size_t size() const noexcept { return incidence.size(); }
};

/// The samples in the coordinates of `pair_point`, in steps of the plan. With the guide g and a floor d the rest of a value is
///   y = (f - g)/(g + d),  f = g + (g + d) y:
/// the ratio less 1 where the guide is well above the floor, the difference in units of the floor where it is not, with nothing between
/// them to decide. d is a tenth of what few samples lie below.
struct GuidedSamples {
  bool isotropic = false;
  SampleSpacing spacing;
  MeanSamples means;
  std::vector<double> floor;  ///< d per channel [1/sr]

  std::vector<Direction> incident, outgoing;     ///< [place]
  std::vector<std::size_t> mean_of;              ///< [place] which mean lies there
  std::vector<std::vector<double>> rest, scale;  ///< [channel][place] y, and g + d [1/sr]
  std::vector<std::vector<double>> log_scale;    ///< [channel][place] ln((g + d) sr)
  std::shared_ptr<const NeighbourTree> places;   ///< of the samples with a value
  std::shared_ptr<const NeighbourTree> masked;   ///< of those without any value: directions known not to be known

  /// The place of a pair in the units of the trees.
  PairPoint place(const Direction& wi, const Direction& wo) const noexcept;
  /// g of every channel for pairs of directions, n · C; 0 where the guide has none or there is no guide. One channel serves for all.
  void guide_values(const Brdf* guide, std::span<const Direction> wi, std::span<const Direction> wo, std::vector<double>& g) const;
};

/// Without a guide (null) y is f in units of the floor. Throws Error(input) if no sample has a value, Error(usage) if the guide has other
/// channels than the data and not a single one.
GuidedSamples guided_samples(const Dataset& data, const Brdf* guide);

/// The same samples held against another guide, or none: their places stay what they are.
GuidedSamples with_guide(GuidedSamples samples, const Brdf* guide);

}  // namespace gonio::tabulated
