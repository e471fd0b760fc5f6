// SPDX-License-Identifier: BSD-3-Clause
// Isotropy as the user states it where no file tells.
#pragma once

#include <filesystem>

#include "brdf/channels.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The answer `--assume isotropic=yes|no`; nothing holds by construction without it. Throws Error(input) for another answer.
Symmetry stated_symmetry(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
