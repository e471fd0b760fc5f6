// SPDX-License-Identifier: BSD-3-Clause
// Mutated documents: nothing but gonio::Error comes out, and a document is valid exactly if it has no faults.
#include <fmt/format.h>

#include <random>
#include <set>

#include "data-schemas/document.hpp"
#include "data-schemas/schema_reference.hpp"
#include "data-schemas/schema_validator.hpp"
#include "tests/check.hpp"

using gonio::Json;
using gonio::Schema;

namespace {

constexpr unsigned seed = 20260701;
constexpr int text_mutations = 20000, value_mutations = 3000;

/// Text with a few bytes replaced, removed, doubled or inserted.
std::string mutated(std::string text, std::mt19937& random) {
  constexpr std::string_view pieces[] = {"{", "}",     "[",   "]",    ",", ":",    "\"", "null",
                                         "-", "1e999", "\\u", "\xff", "0", "true", "\n", "\"a\":"};
  for (auto changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % text.size();
    switch (random() % 5) {
      case 0: text[at] = static_cast<char>(random() % 256); break;
      case 1: text.erase(at, 1 + random() % 8); break;
      case 2: text.insert(at, pieces[random() % std::size(pieces)]); break;
      case 3: text.insert(at, text.substr(random() % text.size(), 1 + random() % 40)); break;
      default: text.resize(at);
    }
  }
  return text;
}

Json odd_value(std::mt19937& random) {
  switch (random() % 10) {
    case 0: return nullptr;
    case 1: return true;
    case 2: return -1;
    case 3: return 1e300;
    case 4: return 0.5;
    case 5: return "";
    case 6: return "fast";
    case 7: return Json::array();
    case 8: return Json::object({{"a/~b", 1}});
    default: return Json(Json::Array{1, "x", nullptr});
  }
}

/// The value with one part replaced, removed or added; which part is drawn on the way down.
Json with_one_change(const Json& value, std::mt19937& random) {
  if (value.size() == 0 || random() % 6 == 0) return odd_value(random);
  const std::size_t chosen = random() % value.size();
  const auto what = random() % 6;
  if (value.is_array()) {
    Json::Array elements = value.elements();
    if (what == 0)
      elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(chosen));
    else if (what == 1)
      elements.push_back(odd_value(random));
    else
      elements[chosen] = with_one_change(elements[chosen], random);
    return elements;
  }
  Json::Members members = value.members();
  if (what == 0)
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(chosen));
  else if (what == 1)
    members.emplace_back("unknown_member", odd_value(random));
  else
    members[chosen].second = with_one_change(members[chosen].second, random);
  return members;
}

struct Example {
  std::string_view name;
  Schema schema;
};

std::vector<Example> examples() {
  std::vector<Example> list;
  for (const std::string_view file : gonio::example_names())
    for (const Schema schema : gonio::every_schema)
      if (file.ends_with(fmt::format(".{}.json", name(schema)))) list.push_back({file, schema});
  return list;
}

}  // namespace

TEST_CASE("mutated text is read or refused, and what is read prints and reads back", "[fuzz]") {
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::vector<Example> list = examples();
  REQUIRE_FALSE(list.empty());
  int read = 0, refused = 0;
  for (int i = 0; i < text_mutations; ++i) {
    const Example& example = list[random() % list.size()];
    const std::string text = mutated(std::string(gonio::example_text(example.name)), random);
    try {
      const Json value = gonio::parse_json(text, "doc");
      ++read;
      if (gonio::parse_json(value.dump(), "again") != value || gonio::parse_json(value.dump(-1), "again") != value) FAIL(text);
      if (i % 10 == 0) gonio::faults_of(value, example.schema, "doc");
    } catch (const gonio::Error& error) {
      ++refused;
      if (error.kind() != gonio::ErrorKind::input || error.faults().empty()) FAIL(error.what());
    }
  }
  CHECK(read > text_mutations / 100);
  CHECK(refused > text_mutations / 100);
}

TEST_CASE("a mutated document is accepted by its schema exactly if it has no faults, and no fault is said twice", "[fuzz]") {
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::vector<Example> list = examples();
  REQUIRE_FALSE(list.empty());
  std::vector<gonio::SchemaValidator> validators;
  for (const Example& example : list) validators.emplace_back(gonio::expanded_schema(fmt::format("{}.schema.json", name(example.schema))));
  int valid = 0, invalid = 0;
  for (int i = 0; i < value_mutations; ++i) {
    const std::size_t which = random() % list.size();
    Json value = gonio::parse_json(gonio::example_text(list[which].name), "doc");
    for (auto changes = 1 + random() % 3; changes > 0; --changes) value = with_one_change(value, random);
    const std::vector<gonio::Fault> faults = gonio::faults_of(value, list[which].schema, "doc");
    const bool accepted = validators[which].accepts(value);
    ++(accepted ? valid : invalid);
    std::set<std::string> places;
    bool explained = true;
    for (const gonio::Fault& fault : faults) {
      places.insert(fault.where + ' ' + fault.found);
      explained = explained && !fault.found.empty() && fault.wanted != "a document that its schema allows";
    }
    if (accepted != faults.empty() || places.size() != faults.size() || !explained) FAIL(value.dump());
  }
  CHECK(valid > 0);
  CHECK(invalid > value_mutations / 2);
}
