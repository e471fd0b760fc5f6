// SPDX-License-Identifier: BSD-3-Clause
// Writing by rename (POSIX).
#include "data-schemas/write_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "brdf/error.hpp"

namespace gonio {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw Error(ErrorKind::input, {path.string(), std::generic_category().message(error), "a place that can be written"});
}

/// A file descriptor that is closed, and, unless released, whose file is removed.
class Output {
 public:
  Output(const std::filesystem::path& path, int flags)
      : path_(path), descriptor_(::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) {}
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (temporary) ::unlink(path_.c_str());
  }

  bool is_open() const { return descriptor_ >= 0; }

  /// 0 or the error number.
  int write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }

  int sync_and_close() {
    const int error = ::fsync(descriptor_) == 0 ? 0 : errno;
    const int closed = ::close(descriptor_) == 0 ? 0 : errno;
    descriptor_ = -1;
    return error ? error : closed;
  }

  bool temporary = false;

 private:
  std::filesystem::path path_;
  int descriptor_;
};

/// Makes the rename itself durable. Some file systems cannot sync a folder; the bytes are safe all the same.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code none;
  const std::filesystem::file_type type = std::filesystem::status(path, none).type();
  if (type == std::filesystem::file_type::directory) refuse(path, EISDIR);
  if (type != std::filesystem::file_type::regular && type != std::filesystem::file_type::not_found) {
    Output output(path, 0);
    if (!output.is_open()) refuse(path, errno);
    if (const int error = output.write(bytes)) refuse(path, error);
    return;
  }
  const std::filesystem::path target = type == std::filesystem::file_type::regular ? std::filesystem::canonical(path, none) : path;
  if (target.empty()) refuse(path, ENOENT);

  static std::atomic<unsigned> counter{0};
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  const std::filesystem::path temporary =
      folder / ('.' + target.filename().string() + '.' + std::to_string(::getpid()) + '.' + std::to_string(counter++) + ".part");
  Output output(temporary, O_CREAT | O_EXCL);
  if (!output.is_open()) refuse(path, errno);
  output.temporary = true;
  if (const int error = output.write(bytes)) refuse(path, error);
  if (const int error = output.sync_and_close()) refuse(path, error);
  if (::rename(temporary.c_str(), target.c_str()) != 0) refuse(path, errno);
  output.temporary = false;
  sync_folder(folder);
}

}  // namespace gonio
