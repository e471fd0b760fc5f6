// SPDX-License-Identifier: BSD-3-Clause
// Text with a few random edits, for the readers of text files, and the law that holds for every one of them.
#pragma once

#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "brdf/error.hpp"

namespace gonio::test {

/// The first `what`, which must be there, as `by`.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);  // npos throws
}

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

struct DamagedFiles {
  int read = 0, refused = 0;
};

/// Hands `rounds` damaged copies of the originals, in turn, to `read`, which may return or throw an Error of kind input with its faults.
/// Anything else fails the test: the round and the seed go to standard error, and the exception on.
template <class Read>
DamagedFiles read_damaged(const std::vector<std::string>& originals, const std::string& letters, unsigned random_seed, int rounds,
                          Read read) {
  std::mt19937 random(random_seed);
  DamagedFiles out;
  for (int round = 0; round < rounds; ++round) {
    const std::string bytes = damaged(originals[static_cast<std::size_t>(round) % originals.size()], letters, random);
    try {
      try {
        read(bytes);
        ++out.read;
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::input || error.faults().empty()) throw std::runtime_error(error.what());
        ++out.refused;
      }
    } catch (...) {
      std::fprintf(stderr, "damaged file: round %d of seed %u\n", round, random_seed);
      throw;
    }
  }
  return out;
}

}  // namespace gonio::test
