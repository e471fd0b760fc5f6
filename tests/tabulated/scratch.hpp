// SPDX-License-Identifier: BSD-3-Clause
// A folder for the files of one test, removed with everything in it at the end.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "brdf/error.hpp"

namespace gonio::test {

class Scratch {
 public:
  Scratch() {
    static std::atomic<int> counter{0};
    folder_ = std::filesystem::temp_directory_path() / fmt::format("gonio-tabulated-{}-{}", ::getpid(), counter++);
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file(const std::string& name, std::string_view bytes) const {
    std::ofstream out(folder_ / name, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Every fault in one text, or "" if nothing was thrown.
template <class Action>
std::string faults_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    std::string out = fmt::format("{}|", name(error.kind()));
    for (const Fault& fault : error.faults()) out += fmt::format("{}|{}|{}\n", fault.where, fault.found, fault.wanted);
    return out;
  }
  return "";
}

}  // namespace gonio::test
