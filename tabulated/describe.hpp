// SPDX-License-Identifier: BSD-3-Clause
// What a data set is, in words for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::tabulated {

using Description = std::vector<std::pair<std::string, std::string>>;

/// Samples, channels, angles covered, uncertainty, masked rows, symmetry, provenance.
Description describe(const Dataset& dataset);

std::string joined_names(const Channels& channels);
std::string words(const Symmetry& symmetry);

}  // namespace gonio::tabulated
