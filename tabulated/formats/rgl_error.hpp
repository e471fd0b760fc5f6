// SPDX-License-Identifier: BSD-3-Clause
// What a reader of a table gets, against its source.
#pragma once

#include "brdf/brdf.hpp"
#include "tabulated/channel_map.hpp"

namespace gonio::tabulated {

/// Mean over the channels of `map` and over 20 000 pairs of directions, random in solid angle, both within 80° of the normal, of
/// |table - source| / source. The source counts as at least a thousandth of its mean over the pairs; where it is not known or negative the
/// pair is left out. NaN if nothing is left.
double mean_relative_error(const Brdf& source, const ChannelMap& map, const Brdf& table, int threads);

}  // namespace gonio::tabulated
