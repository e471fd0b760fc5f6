// SPDX-License-Identifier: BSD-3-Clause
// Pictures by the program gnuplot.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gonio::tools {

/// A text as gnuplot quotes it: 'text'.
std::string gnuplot_quoted(const std::string& text);

/// Runs gnuplot on `script(output)` and puts what it drew at `picture`; `output` is another name beside it, so that nothing half-written
/// ever stands at `picture`. Error(input) if gnuplot is missing or draws nothing.
void draw_with_gnuplot(const std::filesystem::path& picture, const std::function<std::string(const std::filesystem::path& output)>& script);

}  // namespace gonio::tools
