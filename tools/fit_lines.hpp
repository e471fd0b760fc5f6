// SPDX-License-Identifier: BSD-3-Clause
// A fit as lines for people.
#pragma once

#include <string>
#include <vector>

#include "fitting/fit.hpp"

namespace gonio::tools {

/// One line per parameter, metric and check; `masked` was no measurement when the data were read.
std::vector<std::string> fit_lines(const fitting::FitResult& result, const MaskedCounts& masked);

}  // namespace gonio::tools
