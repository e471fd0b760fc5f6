// SPDX-License-Identifier: BSD-3-Clause
// The values of two BRDFs side by side, at directions both know.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::fitting {

/// One side of a comparison: samples, or something that can be evaluated, or both (samples with their interpolation).
struct CompareSubject {
  std::shared_ptr<const Brdf> brdf;
  std::shared_ptr<const Dataset> dataset;

  const Channels& channels() const { return dataset ? dataset->channels : brdf->channels(); }
  Symmetry symmetry() const { return dataset ? dataset->symmetry : brdf->symmetry(); }
};

/// A channel of the comparison: where it stands on either side.
struct ComparedChannel {
  std::string name;
  std::size_t a = 0, b = 0;
};

/// Channels of the same name; otherwise, if one side has a single channel, that one against every channel of the other.
/// Error(input) if neither gives a pair.
std::vector<ComparedChannel> matched_channels(const Channels& a, const Channels& b);

enum class ComparedAt {
  common_directions,  ///< two sets of samples: means of the samples at the same place
  samples_of_a,       ///< every sample of A against B evaluated there
  samples_of_b,       ///< every sample of B against A evaluated there
  quadrature          ///< both evaluated on a grid over the pairs of directions, fine near the highlight
};
const char* name(ComparedAt at) noexcept;  ///< `common-directions`, `samples-of-a`, ...

/// Values of one side: [channel][k] in 1/sr, NaN where it knows nothing.
struct ComparedSide {
  std::vector<std::vector<double>> f, u;                 ///< u is empty or NaN where unknown; evaluated values carry none
  std::vector<std::vector<std::vector<double>>> shared;  ///< [component][channel][k] f · sensitivity · u of a correlated component
};

struct ComparedValues {
  ComparedAt at = ComparedAt::quadrature;
  bool isotropic = false;  ///< only phi_o - phi_i matters on either side
  std::vector<ComparedChannel> channels;
  std::vector<GonioAngles> angles;
  /// What a direction counts for: the measure dwi dwo of its cell under quadrature, 1 for samples.
  std::vector<double> weight;
  ComparedSide a, b;
  bool other_is_samples = false;    ///< under samples_of_a: B was interpolated between samples of its own, whose uncertainty is not carried
  std::size_t without_partner = 0;  ///< samples of A whose place B does not have
};

/// The zenith angle up to which two evaluated BRDFs are compared unless told otherwise: beyond, models part and instruments see nothing
/// (Ngan et al. 2005 fitted to it too).
inline constexpr double compared_up_to_deg = 80;

/// Common directions of two data sets if at least half the places of the smaller one are common; else the samples of A, or of B if only
/// B has samples; else quadrature over theta_i, theta_o <= `theta_max`: midpoints in sqrt(theta_h), theta_d, phi_d (and phi_h unless both
/// sides are isotropic), with dwi dwo = 4 cos theta_d dwh dwd. Error(input) if the channels do not match or nothing is common.
ComparedValues compared_values(const CompareSubject& a, const CompareSubject& b, Angle theta_max);

}  // namespace gonio::fitting
