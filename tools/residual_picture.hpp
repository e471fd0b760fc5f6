// SPDX-License-Identifier: BSD-3-Clause
// Where a fitted model misses its data, as a picture.
#pragma once

#include <filesystem>

#include "fitting/fit.hpp"

namespace gonio::tools {

/// Mean residuals over incident and outgoing zenith angle, one panel a channel, of the six channels that are missed most at most; a number
/// stands in every cell whose mean differs from 0 by more than chance. Error(usage) if nothing was fitted, and where gnuplot_quoted's
/// program fails Error(input).
void draw_residuals(const fitting::FitResult& result, const std::filesystem::path& png);

}  // namespace gonio::tools
