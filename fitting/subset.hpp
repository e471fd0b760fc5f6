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

/// Number of samples of all blocks, valid or not.
std::size_t sample_count(const Observations& observations);

}  // namespace gonio::fitting
