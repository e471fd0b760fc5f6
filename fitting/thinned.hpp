// SPDX-License-Identifier: BSD-3-Clause
// A part of many rows that stands for all of them.
#pragma once

#include "fitting/terms.hpp"

namespace gonio::fitting {

/// About `most` rows, or all if there are no more: rows are sorted into cells of half-vector angle, mirror angle and incidence, an even
/// stride is taken from every cell, and its weights are scaled up to those of the whole cell, so that the cost estimates that of all
/// rows. The cells are narrow where lobes are steep: no peak is lost. Deterministic.
Terms thinned(const Terms& terms, std::size_t most);

}  // namespace gonio::fitting
