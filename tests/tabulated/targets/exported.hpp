// SPDX-License-Identifier: BSD-3-Clause
// Materials of every target with values in their midst, and what reads their text back.
#pragma once

#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "tabulated/targets/target.hpp"

namespace gonio::test {

namespace targets = tabulated::targets;

/// A coloured, slightly anisotropic plastic and a metal.
inline std::vector<LobeSummary> summaries() {
  return {{{0.31, 0.22, 0.13}, {0.041, 0.042, 0.043}, {1, 0.9, 0.8}, 0.21, 0.17},
          {{0.02, 0.03, 0.01}, {0.83, 0.62, 0.31}, {1, 1, 0.9}, 0.12, 0.19},
          {{0.11, 0.12, 0.13}, {0.02, 0.03, 0.04}, {0.5, 0.6, 0.7}, 0.33, 0.33}};
}

inline const targets::RenderTarget& target_named(const std::string& name) {
  for (const auto& target : targets::render_targets())
    if (target.name == name) return target;
  throw std::runtime_error("no target " + name);
}

/// All numbers in a piece of text.
inline std::vector<double> numbers(const std::string& text) {
  std::vector<double> out;
  static const std::regex number(R"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)");
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) out.push_back(std::stod(at->str()));
  return out;
}

/// The numbers that follow the first match of `before`, up to `end`.
inline std::vector<double> after(const std::string& text, const std::string& before, const std::string& end) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error("no '" + before + "' in\n" + text);
  const std::size_t from = at + before.size();
  return numbers(text.substr(from, text.find(end, from) - from));
}

/// Values of a formula from columns of numbers: one of each shared parameter, three of each other one.
inline ChannelValues rows(const std::vector<std::vector<double>>& parameters) {
  ChannelValues out(3);
  for (std::size_t c = 0; c < 3; ++c)
    for (const auto& p : parameters) out[c].push_back(p.size() == 1 ? p[0] : p.at(c));
  return out;
}

}  // namespace gonio::test
