// SPDX-License-Identifier: BSD-3-Clause
// The numbers inside a <ScatteringData> element.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gonio::tabulated {

/// Where a text is not what it should be.
struct TextFault {
  std::size_t offset = 0;  ///< bytes into the text
  std::string found, wanted;
};

/// Walks through numbers that blanks, or one comma and blanks, separate; a comma may follow the last one, as real files have it.
class ScatteringText {
 public:
  explicit ScatteringText(std::string_view text) : text_(text) {}

  std::size_t offset() const noexcept { return offset_; }
  /// The next character that is no blank, or NUL at the end of the text; nothing is taken but blanks.
  char peek() noexcept;
  /// Takes the next character that is no blank if it is this one.
  bool take(char wanted) noexcept;
  /// Takes a finite number and a comma after it, if there is one. Nothing, and the fault, if it is something else.
  std::optional<double> number();
  const TextFault& fault() const noexcept { return fault_; }
  /// What stands at the cursor, as it may stand in a message.
  std::string found() const;

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  TextFault fault_;
};

}  // namespace gonio::tabulated
