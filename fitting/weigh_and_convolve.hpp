// SPDX-License-Identifier: BSD-3-Clause
// The weights of a fit and its means over apertures, each of which needs the other.
#pragma once

#include <vector>

#include "fitting/convolution.hpp"
#include "fitting/large_table.hpp"
#include "fitting/solution.hpp"
#include "fitting/weigher.hpp"

namespace gonio::fitting {

struct Weighed {
  Weighting weighting;
  std::vector<Minimum> minima;  ///< of the fits that this took, the lowest first; none if it took none
};

/// Weights of the terms; and where the data state apertures that count, means over them, found and weighed in turn: the residuals of a
/// model without them would be taken for noise. `effect` says what was done about the apertures.
/// `observations`: null if the terms come from sums, which have no apertures.
Weighed weigh_and_convolve(Terms& terms, const SolveOptions& how, const WeigherOptions& weigher, const Observations* observations,
                           const FitOptions& options, ApertureEffect& effect);

/// Weights of a large table from what its part shows, in `weighting`; false if the part holds wrong readings, so that every sample has to
/// be looked at.
bool weigh_by_part(LargeTable& large, const WeigherOptions& weigher, const SolveOptions& how, Weighting& weighting);

}  // namespace gonio::fitting
