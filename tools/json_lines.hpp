// SPDX-License-Identifier: BSD-3-Clause
// A growing file of JSON documents, one a line, that a kill cannot spoil.
#pragma once

#include <filesystem>
#include <vector>

#include "data-schemas/document.hpp"

namespace gonio::tools {

/// JSON Lines (jsonlines.org): UTF-8, one document a line. A line is on the disk when `append` returns; a process that is killed leaves
/// at most one torn line, the last. While it is open no second JsonLines, in any process, can open the file.
class JsonLines {
 public:
  /// A new file, or with `resume` the one that stands there: its lines must meet `schema`, its last line may be torn and is cut off.
  /// Error(usage) if a file stands there and it is not resumed, Error(input) with every wrong line if it is no such file (it is left
  /// untouched), if another process has it open, or if it cannot be written.
  JsonLines(const std::filesystem::path& path, Schema schema, bool resume);
  ~JsonLines();
  JsonLines(const JsonLines&) = delete;
  JsonLines& operator=(const JsonLines&) = delete;

  /// The lines that stood there.
  const std::vector<Json>& standing() const noexcept { return standing_; }
  /// Adds a line in one write and waits for the disk. Error(input) if it cannot.
  void append(const Json& document);

 private:
  void read_standing(Schema schema);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::vector<Json> standing_;
};

}  // namespace gonio::tools
