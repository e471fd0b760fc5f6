// SPDX-License-Identifier: BSD-3-Clause
// Text with a few random edits, for the readers of text files.
#pragma once

#include <random>
#include <string>

namespace gonio::test {

/// One to three edits: a letter changed, put in, a few taken out, the rest cut off, or a piece of the text repeated elsewhere.
inline std::string damaged(std::string text, const std::string& letters, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t edit = 0, edits = 1 + below(3); edit < edits && !text.empty(); ++edit) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0: text[at] = letters[below(letters.size())]; break;
      case 1: text.insert(at, 1, letters[below(letters.size())]); break;
      case 2: text.erase(at, 1 + below(8)); break;
      case 3: text.resize(at); break;
      default: text.insert(at, text.substr(below(text.size()), below(30))); break;
    }
  }
  return text;
}

}  // namespace gonio::test
