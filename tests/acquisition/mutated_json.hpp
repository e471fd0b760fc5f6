// SPDX-License-Identifier: BSD-3-Clause
// Edits of JSON documents, single ones for tests of one fault and random ones for loaders.
#pragma once

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/json.hpp"

#include "tests/check.hpp"

namespace gonio::test {

using Path = std::vector<std::string>;

/// A copy with the member or element at `path` set; indices as decimal text.
inline Json edited(const Json& document, const Path& path, Json value) {
  if (path.empty()) return value;
  const Path rest(path.begin() + 1, path.end());
  if (document.is_array()) {
    Json out = Json::array();
    for (std::size_t k = 0; k < document.size(); ++k)
      out.push_back(std::to_string(k) == path[0] ? edited(document[k], rest, value) : document[k]);
    return out;
  }
  Json out = document;
  out.set(path[0], edited(document.get(path[0]), rest, std::move(value)));
  return out;
}

/// A copy without the member at `path`.
inline Json removed(const Json& document, const Path& path) {
  Json out = Json::object();
  for (const auto& [name, value] : document.members()) {
    if (name != path[0])
      out.set(name, value);
    else if (path.size() > 1)
      out.set(name, removed(value, {path.begin() + 1, path.end()}));
  }
  return out;
}

/// Feeds `rounds` mutations of `text` to a loader: bytes changed, dropped, doubled, or a number replaced by an extreme one.
/// Returns how many were refused with Error(input); anything else thrown is a failed test.
template <class Load>
std::size_t count_refused(const std::string& text, int rounds, unsigned seed, Load load) {
  static const std::vector<std::string> extremes{"0",     "-1", "1e308", "-1e308", "1e-320", "4294967296", "null",
                                                 "\"x\"", "[]", "{}",    "true",   "0.5",    "1e15"};
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  std::size_t refused = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string mutated = text;
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
      const std::size_t at = below(mutated.size());
      switch (below(5)) {
        case 0: mutated[at] = static_cast<char>(below(256)); break;
        case 1: mutated.erase(at, 1 + below(8)); break;
        case 2: mutated.insert(at, mutated.substr(below(mutated.size()), 1 + below(20))); break;
        default: {
          const std::size_t colon = mutated.find(": ", at);
          if (colon == std::string::npos) break;
          const std::size_t end = mutated.find_first_of(",}\n", colon);
          mutated.replace(colon + 2, end - colon - 2, extremes[below(extremes.size())]);
        }
      }
    }
    INFO("seed " << seed << ", round " << round << ":\n" << mutated);
    try {
      load(parse_json(mutated, "mutated"));
    } catch (const Error& error) {
      ++refused;
      if (error.kind() != ErrorKind::input || error.faults().empty()) FAIL_CHECK("refused with: " << error.what());
    } catch (const std::exception& error) {
      FAIL_CHECK("not an Error: " << error.what());
    }
  }
  return refused;
}

}  // namespace gonio::test
