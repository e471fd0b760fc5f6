// SPDX-License-Identifier: BSD-3-Clause
// Where the tests find reference values and measured data that are not part of the repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace gonio::test {

/// `relative` below the folder of shared material (GONIO_SHARED, or `shared` beside the checkout), if it is there.
inline std::optional<std::filesystem::path> shared_file(const std::filesystem::path& relative) {
  const char* variable = std::getenv("GONIO_SHARED");
  const std::filesystem::path root =
      variable ? std::filesystem::path(variable) : std::filesystem::path(GONIO_SOURCE_DIR).parent_path() / "shared";
  if (std::filesystem::exists(root / relative)) return root / relative;
  return std::nullopt;
}

/// A file of measured data: below GONIO_DATA if that is set, else `data` of the shared material. Where it is missing the test that asked
/// says that it is skipped, and has to return.
std::optional<std::filesystem::path> measured_data(const std::filesystem::path& relative);

/// The file of measured_data in quotes for the shell, or "".
std::string measured_argument(const std::filesystem::path& relative);

}  // namespace gonio::test
