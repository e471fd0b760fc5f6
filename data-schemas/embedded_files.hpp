// SPDX-License-Identifier: BSD-3-Clause
// The list of built-in files as CMake writes it (embed.cmake).
#pragma once

#include <span>
#include <string_view>

namespace gonio {

struct EmbeddedFile {
  std::string_view path;  ///< relative to data-schemas/
  std::string_view text;
};

/// Sorted by path.
std::span<const EmbeddedFile> embedded_files();

}  // namespace gonio
