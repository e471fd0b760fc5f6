// SPDX-License-Identifier: BSD-3-Clause
// gonio fit --merge: one fit of what gonio collapse made of many files.
#pragma once

#include <string>
#include <vector>

#include "tools/fit_flags.hpp"

namespace gonio::tools {

/// Adds up the statistics of all files, fits and reports as a single fit does. Errors of other metrics than theirs are unknown: null.
int fit_merged(const std::vector<std::string>& files, const FitRequest& request, const std::string& out, Console& console);

}  // namespace gonio::tools
