// SPDX-License-Identifier: BSD-3-Clause
// Text files of key words and numbers without a fixed layout of lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {

/// Hands out the words of a text one by one; lines that start with `#` are comments.
class KeywordText {
 public:
  /// `text`, which begins with line `first_line` of the file, must outlive the object.
  KeywordText(std::string_view text, FaultList& faults, std::size_t first_line = 1);

  struct Word {
    std::string_view text;
    std::size_t line = 0;
  };
  /// The next word without taking it; empty at the end of the text.
  const Word& peek() const noexcept { return word_; }
  Word next();
  bool at_end() const noexcept { return word_.text.empty(); }
  /// Takes the next word if it is `keyword` in whatever case.
  bool take(std::string_view keyword);

  /// The next word as a finite number; a fault (once per call, `what` names the number) and nothing if it is none.
  std::optional<double> number(std::string_view what);
  /// A whole number from 1 on; 0 and a fault if it is none or the rest of the text cannot hold so many numbers.
  std::size_t count(std::string_view what);
  /// So many finite numbers; empty and a fault if one is none.
  std::vector<double> list(std::size_t length, std::string_view what);
  /// A count and as many finite numbers. A count that the rest of the text cannot hold is a fault before anything is allocated.
  std::vector<double> counted_list(std::string_view what);
  /// True if the rest of the text is long enough for `count` numbers.
  bool can_hold(std::size_t count) const noexcept { return count <= text_.size() / 2 + 1; }

  /// The comment lines met so far, without their `#`.
  const std::vector<std::string>& comments() const noexcept { return comments_; }

 private:
  void advance();

  std::string_view text_;  ///< what follows the word
  std::size_t line_ = 1;
  bool line_begins_ = true;
  Word word_;
  std::vector<std::string> comments_;
  FaultList& faults_;
};

/// Equal but for the case of the ASCII letters.
bool same_word(std::string_view a, std::string_view b) noexcept;

/// True if a line of `text` begins with this key word (blanks before it allowed) and something other than a letter or digit follows.
bool has_keyword_line(std::string_view text, std::string_view keyword);

/// Adds a fault unless the angles are increasing and within the range.
void require_angles(const std::vector<double>& angles, std::string_view what, double low, double high, FaultList& faults);

}  // namespace gonio::tabulated
