// SPDX-License-Identifier: BSD-3-Clause
// How a run store reaches the disk; a seam for the tests that lose power.
#pragma once

#include <string>

namespace gonio::acquisition {

/// Anything but the default gives up a promise or is for tests: `synced = false` is SQLite's synchronous = OFF, `vfs` names a
/// file system layer registered with SQLite.
struct RunStorage {
  bool synced = true;
  std::string vfs;
};

}  // namespace gonio::acquisition
