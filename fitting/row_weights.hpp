// SPDX-License-Identifier: BSD-3-Clause
// Weights of collapsed rows from the scatter inside them.
#pragma once

#include <vector>

#include "fitting/terms.hpp"
#include "fitting/variance_model.hpp"

namespace gonio::fitting {

/// Every row of collapsed terms by its own scatter, drawn towards the model of all rows of its channel, which comes back.
std::vector<VarianceModel> weigh_rows(Terms& terms);

}  // namespace gonio::fitting
