// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "brdf/error.hpp"

namespace gonio::tabulated {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const auto refuse = [&](int reason) { throw Error(ErrorKind::input, {path.string(), std::strerror(reason), "a readable file"}); };
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(errno);
  struct stat status {};
  int reason = ::fstat(file, &status) == 0 ? 0 : errno;
  if (reason == 0 && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    address_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0);
    if (address_ == MAP_FAILED) reason = errno;
  }
  ::close(file);
  if (reason != 0) refuse(reason);
}

MappedFile::~MappedFile() {
  if (address_ != nullptr) ::munmap(address_, size_);
}

}  // namespace gonio::tabulated
