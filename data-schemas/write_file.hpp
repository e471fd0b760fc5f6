// SPDX-License-Identifier: BSD-3-Clause
// Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace gonio {

/// Writes a file whole or not at all: a temporary file beside it, fsync, rename, fsync of the folder. Whoever opens the path sees the
/// old bytes or the new ones. A symbolic link is followed, and something that is no regular file (a pipe, /dev/null) is written to
/// directly: replacing it would destroy it. Error(input) if it cannot; then nothing is left behind and an old file is untouched.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gonio
