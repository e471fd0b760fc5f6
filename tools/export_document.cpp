// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace gonio::tools {
namespace {

struct NamedCount {
  const char* name;
  const char* words;
  std::size_t tabulated::ExportNotes::*count;
};

constexpr std::array counts{
    NamedCount{"n_nodes", "nodes written", &tabulated::ExportNotes::n_nodes},
    NamedCount{"n_below_horizon", "nodes of the grid below the horizon", &tabulated::ExportNotes::n_below_horizon},
    NamedCount{"n_unknown", "nodes where nothing is known", &tabulated::ExportNotes::n_unknown},
    NamedCount{"n_negative", "nodes with a negative value", &tabulated::ExportNotes::n_negative},
    NamedCount{"n_extrapolated", "nodes beyond the samples", &tabulated::ExportNotes::n_extrapolated},
};

}  // namespace

Json notes_document(const tabulated::ExportNotes& notes) {
  Json files = Json::array(), facts = Json::object(), assume = Json::object(), lost = Json::array();
  for (const auto& file : notes.files) files.push_back(file.string());
  for (const auto& [key, words] : notes.facts) facts.set(key, words);
  for (const auto& [key, answer] : notes.assume) assume.set(key, answer);
  for (const std::string& sentence : notes.lost) lost.push_back(sentence);
  Json document = Json::object({{"files", std::move(files)}});
  for (const NamedCount& entry : counts) document.set(entry.name, static_cast<std::int64_t>(notes.*entry.count));
  document.set("facts", std::move(facts));
  document.set("assume", std::move(assume));
  document.set("lost", std::move(lost));
  return document;
}

std::vector<std::string> notes_lines(const tabulated::ExportNotes& notes) {
  std::vector<std::pair<std::string, std::string>> facts = notes.facts;
  for (const NamedCount& entry : counts)
    if (notes.*entry.count > 0) facts.emplace_back(entry.words, std::to_string(notes.*entry.count));
  for (const auto& [key, answer] : notes.assume) facts.emplace_back("read back with", fmt::format("--assume {}={}", key, answer));
  std::size_t width = 0;
  for (const auto& [key, words] : facts) width = std::max(width, key.size());
  std::vector<std::string> out;
  for (const auto& [key, words] : facts) out.push_back(fmt::format("  {:<{}}  {}", key, width, words));
  for (const std::string& sentence : notes.lost) out.push_back("  lost: " + sentence);
  return out;
}

}  // namespace gonio::tools
