// SPDX-License-Identifier: BSD-3-Clause
// Running the gonio program as a user does, in a folder of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "data-schemas/json.hpp"

namespace gonio::test {

/// A new folder that is removed with everything in it.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gonio-test-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_file(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

struct Outcome {
  int code = -1;
  std::string out, err;
  Json json() const { return parse_json(out, "standard output"); }
};

/// `gonio ARGUMENTS` by the shell, standard input from `in`.
inline Outcome gonio(const std::string& arguments, const std::string& in = "") {
  const Folder folder;
  write_file(folder / "in", in);
  const auto quoted = [&](const char* name) { return " '" + (folder / name).string() + "'"; };
  const std::string command =
      std::string("'") + GONIO_BINARY + "' " + arguments + " <" + quoted("in") + " >" + quoted("out") + " 2>" + quoted("err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(folder / "out"), read_file(folder / "err")};
}

}  // namespace gonio::test
