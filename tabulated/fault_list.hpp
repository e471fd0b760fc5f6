// SPDX-License-Identifier: BSD-3-Clause
// Collects the faults of one file: the first ones in full, the rest as a number.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "brdf/error.hpp"

namespace gonio::tabulated {

class FaultList {
 public:
  /// Faults beyond this many are only counted: a file of a million bad rows shall not fill the screen or the memory.
  static constexpr std::size_t shown = 20;

  explicit FaultList(std::string file) : file_(std::move(file)) {}

  void add(std::string where, std::string found, std::string wanted);
  /// The same for line `line` of the file.
  void add_at(std::size_t line, std::string found, std::string wanted);

  bool empty() const noexcept { return count_ == 0; }
  const std::string& file() const noexcept { return file_; }
  /// Throws Error(input) with everything collected, if there is anything.
  void raise() const;

 private:
  std::string file_;
  std::size_t count_ = 0;
  std::vector<Fault> faults_;
};

/// Text of a file as it may stand in a message: cut to 40 characters, control characters and bytes beyond ASCII as \xNN, in quotes.
std::string excerpt(std::string_view text);

}  // namespace gonio::tabulated
