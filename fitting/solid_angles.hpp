// SPDX-License-Identifier: BSD-3-Clause
// How much of all pairs of directions each sample of a grid stands for.
#pragma once

#include <vector>

#include "brdf/observations.hpp"

namespace gonio::fitting {

/// The measure dωi dωo that every sample stands for, in the order of the observations, over its mean: pure numbers around 1.
///   tables of constant θh  4 cos θd sin θd dθd · sin θh dθh; the measure of the half-difference angles, in which the Jacobian of the
///                          half vector, 4 cos θd, is what is mostly forgotten (numerics A)
///   grids                  sin θi dθi dφi · sin θo dθo dφo for samples on a product of values of θi, φi, θo and φo; holes are allowed
/// Cells end half way between neighbouring nodes, at the ends of an axis half a step beyond, and at the pole and the horizon.
/// Error(usage) for other samples: scattered directions have no cells.
std::vector<double> solid_angles(const Observations& observations);

}  // namespace gonio::fitting
