// SPDX-License-Identifier: BSD-3-Clause
// Some of the samples of other observations.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "brdf/observations.hpp"

namespace gonio::fitting {

/// The samples k with keep[k] != 0, counted through all blocks in order; what was no measurement stays none. Nothing else is copied, and
/// samples keep their numbers, so that sensitivities of correlated components still fit. Error(internal) if `keep` has another length.
std::shared_ptr<const Observations> subset(std::shared_ptr<const Observations> all, std::vector<std::uint8_t> keep);

/// A copy of those of them that are measurements, with all that the observations know of them (uncertainties, read variances, apertures,
/// correlated components), for work that would walk through a large table again and again. Samples are numbered anew.
std::shared_ptr<const Observations> copied(const Observations& all, const std::vector<std::uint8_t>& keep);

/// Number of samples of all blocks, valid or not.
std::size_t sample_count(const Observations& observations);

}  // namespace gonio::fitting
