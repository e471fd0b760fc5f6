// SPDX-License-Identifier: BSD-3-Clause
// Where the measured data of others may be found; tests on them say so when it is not there.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace gonio::tests {

inline std::filesystem::path real_data(const std::string& name) {
  const char* folder = std::getenv("GONIO_DATA");
  return (folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path(GONIO_SOURCE_DIR) / "../shared/data") / name;
}

}  // namespace gonio::tests

/// Leaves the test with a warning if the file is not there. The one assertion keeps such a test from counting as empty.
#define REQUIRE_REAL_DATA(path)                                          \
  if (!std::filesystem::exists(path)) {                                  \
    WARN("skipped: no measured data at " << path << ", set GONIO_DATA"); \
    SUCCEED();                                                           \
    return;                                                              \
  }
