// SPDX-License-Identifier: BSD-3-Clause
// Writing a file whole or not at all.
#pragma once

#include <filesystem>
#include <functional>

namespace gonio::tabulated {

/// Calls `write` with the name of a temporary file in the same folder, then syncs it and renames it to `path`. If `write` throws or
/// the disk refuses, the temporary file is removed and whatever stood at `path` is untouched. Throws Error(input) naming `path`.
void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path& temporary)>& write);

}  // namespace gonio::tabulated
