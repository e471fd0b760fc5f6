// SPDX-License-Identifier: BSD-3-Clause
#include "tests/shared_data.hpp"

#include <cstdlib>

#include "tests/check.hpp"

namespace gonio::test {

std::optional<std::filesystem::path> measured_data(const std::filesystem::path& relative) {
  std::optional<std::filesystem::path> path;
  if (const char* variable = std::getenv("GONIO_DATA")) {
    const std::filesystem::path file = std::filesystem::path(variable) / relative;
    if (std::filesystem::exists(file)) path = file;
  } else {
    path = shared_file(std::filesystem::path("data") / relative);
  }
  if (!path) WARN("skipped: no measured data at " << relative.string() << ", set GONIO_DATA");
  SUCCEED();  // a skipped test is not one that lost its assertions
  return path;
}

std::string measured_argument(const std::filesystem::path& relative) {
  const auto path = measured_data(relative);
  return path ? "'" + path->string() + "'" : "";
}

}  // namespace gonio::test
