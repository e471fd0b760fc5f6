// SPDX-License-Identifier: BSD-3-Clause
// The global search where the profile comes from sums over very many rows: wide on a few of them, narrow on all.
#pragma once

#include "fitting/global_search.hpp"

namespace gonio::fitting {

/// For terms with `sums` and one free parameter. The scan and its minima are those of a part of the rows; around the lowest the sums of all
/// rows are prepared over a stretch far wider than the parameter is uncertain, and the minimum is refined there. `Found::scan` holds
/// points of that stretch. Where the data leave the parameter open, all rows are scanned.
Found search_on_sums(const Profile& profile, const SearchSpace& space, int threads);

}  // namespace gonio::fitting
