// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/replace_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "brdf/error.hpp"

namespace gonio::tabulated {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int reason) {
  throw Error(ErrorKind::input, {path.string(), std::strerror(reason), "a place where a file can be written"});
}

void sync(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(path, errno);
  const int failed = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (failed != 0) refuse(path, failed);
}

}  // namespace

void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path& temporary)>& write) {
  static std::atomic<unsigned> counter{0};
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}-{}.part", ::getpid(), counter++);
  try {
    write(temporary);
    sync(temporary, path);
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error) refuse(path, error.value());
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace gonio::tabulated
