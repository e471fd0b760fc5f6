// SPDX-License-Identifier: BSD-3-Clause
// A run file as samples.
#pragma once

#include <filesystem>

#include "tabulated/open.hpp"

namespace gonio::tools {

/// Opens a run file and reduces it; the samples carry the run's name in their provenance.
tabulated::Opened reduced_run(const std::filesystem::path& path);

}  // namespace gonio::tools
