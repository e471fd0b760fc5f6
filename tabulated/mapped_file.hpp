// SPDX-License-Identifier: BSD-3-Clause
// A file as read-only memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace gonio::tabulated {

/// Maps a whole file, pages filled in advance (one system call instead of a page fault per 64 kB). The memory is good as long as
/// the object lives and nobody shortens the file.
class MappedFile {
 public:
  /// Throws Error(input) if the file cannot be mapped.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const noexcept { return {static_cast<const std::byte*>(address_), size_}; }

 private:
  void* address_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace gonio::tabulated
