// SPDX-License-Identifier: BSD-3-Clause
// An SQLite file system layer on a disk that keeps nothing until it is told to.
#pragma once

#include <string>

namespace gonio::acquisition::test {

/// Writes, and changes of size, stay in memory until the file is synced; reads see them. `lose_power` throws all that is pending away and
/// lets nothing more reach the disk, as a power failure would. Deleting and making files acts at once.
class LostWritesVfs {
 public:
  LostWritesVfs();  ///< registers it; one at a time
  ~LostWritesVfs();
  LostWritesVfs(const LostWritesVfs&) = delete;
  LostWritesVfs& operator=(const LostWritesVfs&) = delete;

  static std::string name() { return "lost-writes"; }
  void lose_power();
};

}  // namespace gonio::acquisition::test
