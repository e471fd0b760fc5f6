// SPDX-License-Identifier: BSD-3-Clause
// Where the tests find reference values and measured data that are not part of the repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace gonio::test {

/// `relative` below the folder of shared material (GONIO_SHARED, or `shared` beside the checkout), if it is there.
inline std::optional<std::filesystem::path> shared_file(const std::filesystem::path& relative) {
  const char* variable = std::getenv("GONIO_SHARED");
  const std::filesystem::path root =
      variable ? std::filesystem::path(variable) : std::filesystem::path(GONIO_SOURCE_DIR).parent_path() / "shared";
  if (std::filesystem::exists(root / relative)) return root / relative;
  return std::nullopt;
}

/// A file of measured data: below GONIO_DATA if that is set, else `data` of the shared material.
inline std::optional<std::filesystem::path> data_file(const std::filesystem::path& relative) {
  if (const char* variable = std::getenv("GONIO_DATA")) {
    const std::filesystem::path path = std::filesystem::path(variable) / relative;
    return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
  }
  return shared_file(std::filesystem::path("data") / relative);
}

}  // namespace gonio::test
