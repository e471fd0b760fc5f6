// SPDX-License-Identifier: BSD-3-Clause
#include "tools/json_lines.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace gonio::tools {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw Error(ErrorKind::input, {path.string(), std::generic_category().message(error), "a file that can be written"});
}

/// What a killed process leaves: the beginning of an object, or zeros that the file system put in the place of bytes it lost.
bool may_be_torn(std::string_view line) { return line.empty() || line[0] == '{' || line[0] == '\0'; }

}  // namespace

JsonLines::JsonLines(const std::filesystem::path& path, Schema schema, bool resume) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | (resume ? 0 : O_EXCL), 0666);
  if (descriptor_ < 0 && errno == EEXIST)
    throw Error(ErrorKind::usage, {path.string(), "a file that stands there", "--resume to go on with it, or another name"});
  if (descriptor_ < 0) refuse(path, errno);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw Error(ErrorKind::input, {path.string(), "open in another process", "a file of its own for every process"});
    if (resume) read_standing(schema);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

JsonLines::~JsonLines() { ::close(descriptor_); }

void JsonLines::read_standing(Schema schema) {
  const std::string text = read_file(path_);
  std::vector<Fault> faults;
  std::size_t begin = 0;
  bool ends_in_line_feed = true;
  for (std::size_t number = 1; begin < text.size(); ++number) {
    const std::size_t line_feed = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, line_feed == text.npos ? text.npos : line_feed - begin);
    const std::size_t next = line_feed == text.npos ? text.size() : line_feed + 1;
    const std::string where = path_.string() + ":" + std::to_string(number);
    std::optional<Json> document;
    try {
      document = parse_json(line, where);
    } catch (const Error& error) {
      if (next == text.size() && may_be_torn(line)) break;
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
    if (document) {
      const std::vector<Fault> wrong = faults_of(*document, schema, where);
      faults.insert(faults.end(), wrong.begin(), wrong.end());
      standing_.push_back(std::move(*document));
      ends_in_line_feed = line_feed != text.npos;
    }
    begin = next;
  }
  if (!faults.empty()) throw Error(ErrorKind::input, path_.string() + " holds other lines than a " + name(schema), std::move(faults));
  if (begin < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(begin)) != 0) refuse(path_, errno);
  if (!ends_in_line_feed && ::write(descriptor_, "\n", 1) != 1) refuse(path_, errno);
}

void JsonLines::append(const Json& document) {
  const std::string line = document.dump(-1) + "\n";
  const ssize_t written = ::write(descriptor_, line.data(), line.size());
  if (written < 0) refuse(path_, errno);
  if (static_cast<std::size_t>(written) != line.size()) refuse(path_, ENOSPC);  // the torn line is cut off by the next resume
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) refuse(path_, errno);
}

}  // namespace gonio::tools
