// SPDX-License-Identifier: BSD-3-Clause
// Which places of a document break its schema. The validator says yes or no; asked about one part of the schema at a time, it also
// says where: objects, arrays and alternatives are walked here, and every other keyword is its answer.
#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "data-schemas/document.hpp"
#include "data-schemas/fault_text.hpp"
#include "data-schemas/schema_reference.hpp"
#include "data-schemas/schema_validator.hpp"

namespace gonio {
namespace {

/// Longest text of a document. The validator matches patterns by recursion, a frame or more for each character.
constexpr std::size_t longest_string = 4096;

/// Where the walk is: a JSON pointer (RFC 6901) and, to sort by, the index of each member or element on the way.
struct Place {
  std::string pointer;
  std::vector<std::size_t> position;

  Place member(std::string_view name, std::size_t index) const {
    Place place{pointer + '/', position};
    for (const char character : name)
      if (character == '~')
        place.pointer += "~0";
      else if (character == '/')
        place.pointer += "~1";
      else
        place.pointer += character;
    place.position.push_back(index);
    return place;
  }
  Place element(std::size_t index) const { return member(std::to_string(index), index); }
};

struct PlacedFault {
  /// A value is wrong; it is none of the values of a `const` or `enum`, which may be what tells alternatives apart; or a member is missing.
  enum class Kind { value, choice, missing };
  Place place;
  std::string found, wanted;
  Kind kind = Kind::value;
};

bool is_walked(std::string_view keyword) {
  constexpr std::string_view walked[] = {"properties",
                                         "patternProperties",
                                         "additionalProperties",
                                         "required",
                                         "items",
                                         "additionalItems",
                                         "allOf",
                                         "anyOf",
                                         "oneOf",
                                         "if",
                                         "then",
                                         "else"};
  return std::find(std::begin(walked), std::end(walked), keyword) != std::end(walked);
}

/// An expanded schema that can say which places of a value break it.
class FaultFinder {
 public:
  explicit FaultFinder(Json schema) : schema_(std::move(schema)), whole_(schema_) {}

  std::vector<Fault> faults(const Json& document, const std::string& source) {
    std::vector<PlacedFault> found;
    find_long_strings(document, {}, found);
    if (found.empty()) {
      if (whole_.accepts(document)) return {};
      const std::lock_guard lock(mutex_);
      find(schema_, document, {}, found);
    }
    if (found.empty()) found.push_back({{}, found_text(document), "a document that its schema allows"});
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.place.position < b.place.position; });
    std::vector<Fault> faults;
    for (PlacedFault& fault : found) {
      std::string where = source + '#' + fault.place.pointer;
      const bool is_repeated = !faults.empty() && faults.back().where == where && faults.back().found == fault.found;
      if (!is_repeated) faults.push_back({std::move(where), std::move(fault.found), std::move(fault.wanted)});
    }
    return faults;
  }

 private:
  using Found = std::vector<PlacedFault>;

  static void find_long_strings(const Json& value, const Place& place, Found& found) {
    const auto check = [&](const std::string& text, const Place& at) {
      if (text.size() > longest_string)
        found.push_back({at, "a string of " + std::to_string(text.size()) + " bytes", "at most " + std::to_string(longest_string)});
      return text.size() <= longest_string;
    };
    if (value.is_string()) {
      check(value.string(), place);
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) find_long_strings(value[i], place.element(i), found);
    } else if (value.is_object()) {
      std::size_t index = 0;
      for (const auto& [name, member] : value.members()) {
        if (check(name, place.member(name.substr(0, longest_string), index))) find_long_strings(member, place.member(name, index), found);
        ++index;
      }
    }
  }

  bool accepts(const Json& schema, const Json& value) {
    auto [entry, is_new] = validators_.try_emplace(&schema);
    if (is_new) entry->second.emplace(schema);
    return entry->second->accepts(value);
  }

  /// Is the value fine by the keywords that are not walked?
  bool accepts_own_keywords(const Json& schema, const Json& value) {
    auto [entry, is_new] = own_keywords_.try_emplace(&schema);
    if (is_new) {
      Json own = Json::object();
      for (const auto& [keyword, argument] : schema.members())
        if (!is_walked(keyword)) own.set(keyword, argument);
      entry->second.emplace(own);
    }
    return entry->second->accepts(value);
  }

  void find(const Json& schema, const Json& value, const Place& place, Found& found) {
    if (!schema.is_object()) {  // `true` or `false`
      if (!accepts(schema, value)) found.push_back({place, found_text(value), "nothing here"});
      return;
    }
    if (!accepts_own_keywords(schema, value)) {
      found.push_back({place, found_text(value), wanted_text(schema),
                       schema.contains("const") || schema.contains("enum") ? PlacedFault::Kind::choice : PlacedFault::Kind::value});
    }
    if (value.is_object()) find_in_object(schema, value, place, found);
    if (value.is_array()) find_in_array(schema, value, place, found);
    if (const Json& all = schema.get("allOf"); all.is_array())
      for (const Json& part : all.elements()) find(part, value, place, found);
    if (schema.contains("if")) {
      const char* consequence = accepts(schema.at("if"), value) ? "then" : "else";
      if (schema.contains(consequence)) find(schema.at(consequence), value, place, found);
    }
    for (const char* alternatives : {"anyOf", "oneOf"})
      if (schema.contains(alternatives)) find_in_alternatives(schema, alternatives, value, place, found);
  }

  void find_in_object(const Json& schema, const Json& value, const Place& place, Found& found) {
    const Json &properties = schema.get("properties"), &patterns = schema.get("patternProperties");
    const Json* others = schema.contains("additionalProperties") ? &schema.at("additionalProperties") : nullptr;
    std::size_t index = 0;
    for (const auto& [name, member] : value.members()) {
      const Place at = place.member(name, index++);
      bool is_known = properties.contains(name);
      if (is_known) find(properties.at(name), member, at, found);
      if (patterns.is_object())
        for (const auto& [pattern, member_schema] : patterns.members())
          if (SchemaValidator(Json::object({{"pattern", pattern}})).accepts(Json(name))) {
            is_known = true;
            find(member_schema, member, at, found);
          }
      if (is_known || !others) continue;
      if (others->is_bool() && !others->boolean()) {
        std::vector<std::string> known;
        if (properties.is_object())
          for (const auto& [other, ignored] : properties.members()) known.push_back(other);
        found.push_back({at, "an unknown member", wanted_member_text(name, known)});
      } else {
        find(*others, member, at, found);
      }
    }
    if (const Json& required = schema.get("required"); required.is_array())
      for (const Json& name : required.elements())
        if (!value.contains(name.string())) {
          const std::string quoted = name.dump();
          const std::string what = properties.contains(name.string()) ? ": " + wanted_text(properties.at(name.string())) : "";
          found.push_back({place, "no member " + quoted, quoted + what, PlacedFault::Kind::missing});
        }
  }

  void find_in_array(const Json& schema, const Json& value, const Place& place, Found& found) {
    if (!schema.contains("items")) return;
    const Json& items = schema.at("items");
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!items.is_array())
        find(items, value[i], place.element(i), found);
      else if (i < items.size())
        find(items[i], value[i], place.element(i), found);
      else if (schema.contains("additionalItems"))
        find(schema.at("additionalItems"), value[i], place.element(i), found);
    }
  }

  /// No alternative accepts the value: says what is wrong with the one that was meant, and where that cannot be told, what all want.
  void find_in_alternatives(const Json& schema, const char* keyword, const Json& value, const Place& place, Found& found) {
    std::vector<Found> meant;  // faults of each alternative that the value itself, apart from its parts, would fit
    std::size_t accepted = 0;
    for (const Json& alternative : schema.at(keyword).elements()) {
      if (accepts(alternative, value)) ++accepted;
      Found own;
      find(alternative, value, place, own);
      const bool fits = std::none_of(own.begin(), own.end(), [&](const PlacedFault& fault) {
        return fault.place.pointer == place.pointer && fault.kind != PlacedFault::Kind::missing;
      });
      if (fits) meant.push_back(std::move(own));
    }
    if (accepted == 1 || (accepted > 1 && keyword == std::string_view("anyOf"))) return;
    if (accepted > 1) {
      found.push_back({place, found_text(value) + " that fits several alternatives", "exactly one of them"});
      return;
    }
    if (meant.empty()) {
      found.push_back({place, found_text(value), wanted_text(schema)});
      return;
    }
    const auto choice_of = [&](const Found& faults) {
      return std::find_if(faults.begin(), faults.end(), [&](const PlacedFault& fault) {
        return fault.kind == PlacedFault::Kind::choice && fault.place.position.size() == place.position.size() + 1;
      });
    };
    // A member such as "kind" tells the alternatives apart: if it fits none, it is the fault, and its wanted values are all of theirs.
    const bool chosen = std::any_of(meant.begin(), meant.end(), [&](const Found& faults) { return choice_of(faults) == faults.end(); });
    if (!chosen) {
      PlacedFault fault = *choice_of(meant.front());
      for (std::size_t i = 1; i < meant.size(); ++i)
        if (const auto& other = *choice_of(meant[i]); fault.wanted.find(other.wanted) == std::string::npos)
          fault.wanted += " or " + other.wanted;
      found.push_back(std::move(fault));
      return;
    }
    std::erase_if(meant, [&](const Found& faults) { return choice_of(faults) != faults.end(); });
    const auto& nearest = *std::min_element(meant.begin(), meant.end(), [](const Found& a, const Found& b) { return a.size() < b.size(); });
    found.insert(found.end(), nearest.begin(), nearest.end());
  }

  Json schema_;
  SchemaValidator whole_;
  std::mutex mutex_;  ///< of the two caches, which are filled while a wrong document is explained
  std::map<const Json*, std::optional<SchemaValidator>> validators_, own_keywords_;
};

/// Made on first use: a program that reads no document pays nothing.
FaultFinder& finder(Schema schema) {
  static std::array<std::optional<FaultFinder>, schema_count> finders;
  static std::array<std::once_flag, schema_count> made;
  const auto index = static_cast<std::size_t>(schema);
  std::call_once(made[index], [&] { finders[index].emplace(expanded_schema(std::string(name(schema)) + ".schema.json")); });
  return *finders[index];
}

}  // namespace

std::vector<Fault> faults_of(const Json& document, Schema schema, const std::string& source) {
  return finder(schema).faults(document, source);
}

std::vector<Fault> faults_of(const Json& document, std::string_view schema, const std::string& source) {
  return FaultFinder(expanded_schema_text(schema, "schema")).faults(document, source);
}

}  // namespace gonio
