// SPDX-License-Identifier: BSD-3-Clause
// Wording of faults.
#include "data-schemas/fault_text.hpp"

#include <algorithm>
#include <numeric>

namespace gonio {
namespace {

constexpr std::size_t longest_found = 60;  ///< bytes of a value shown in a message

/// At most `limit` bytes, cut between characters.
std::string shortened(std::string text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t end = limit;
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (const std::string& part : parts) (text += text.empty() ? "" : separator) += part;
  return text;
}

std::string counted(std::int64_t count, const std::string& noun) { return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s"); }

/// ` of 2 to 4 elements`, ` of at least 1 element`; empty without limits.
std::string size_text(const Json& schema, std::string_view lower_key, std::string_view upper_key, const std::string& noun) {
  const Json &lower = schema.get(lower_key), &upper = schema.get(upper_key);
  if (lower.is_null() && upper.is_null()) return {};
  if (upper.is_null()) return " of at least " + counted(lower.integer(), noun);
  if (lower.is_null()) return " of at most " + counted(upper.integer(), noun);
  if (lower == upper) return " of " + counted(lower.integer(), noun);
  return " of " + std::to_string(lower.integer()) + " to " + counted(upper.integer(), noun);
}

std::string range_text(const Json& schema) {
  const Json &lower = schema.get("minimum"), &upper = schema.get("maximum");
  const Json &above = schema.get("exclusiveMinimum"), &below = schema.get("exclusiveMaximum");
  if (!lower.is_null() && !upper.is_null()) return " from " + lower.dump() + " to " + upper.dump();
  std::vector<std::string> parts;
  if (!lower.is_null()) parts.push_back("of at least " + lower.dump());
  if (!above.is_null()) parts.push_back("above " + above.dump());
  if (!upper.is_null()) parts.push_back(parts.empty() ? "of at most " + upper.dump() : "at most " + upper.dump());
  if (!below.is_null()) parts.push_back("below " + below.dump());
  if (const Json& step = schema.get("multipleOf"); !step.is_null()) parts.push_back("a multiple of " + step.dump());
  return parts.empty() ? "" : ' ' + joined(parts, " and ");
}

std::string type_text(const std::string& type, const Json& schema) {
  if (type == "number") return "a number" + range_text(schema);
  if (type == "integer") return "an integer" + range_text(schema);
  if (type == "boolean") return "true or false";
  if (type == "array") {
    const std::string different = schema.boolean_or("uniqueItems", false) ? ", all different" : "";
    return "an array" + size_text(schema, "minItems", "maxItems", "element") + different;
  }
  if (type == "object") return "an object" + size_text(schema, "minProperties", "maxProperties", "member");
  if (type != "string") return type;
  if (const Json& pattern = schema.get("pattern"); !pattern.is_null()) return "a string that matches " + pattern.string();
  return "a string" + size_text(schema, "minLength", "maxLength", "character");
}

/// What each of the alternatives wants, without repetition.
std::string any_of_text(const Json& schemas) {
  std::vector<std::string> parts;
  for (const Json& schema : schemas.elements())
    if (std::string part = wanted_text(schema); std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
  return joined(parts, " or ");
}

}  // namespace

std::string found_text(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_array()) return "an array of " + counted(static_cast<std::int64_t>(value.size()), "element");
  if (value.is_object()) return "an object of " + counted(static_cast<std::int64_t>(value.size()), "member");
  return shortened(value.dump(-1), longest_found) + " (" + value.type_name() + ')';
}

std::string wanted_text(const Json& schema) {
  if (const Json& value = schema.get("const"); schema.contains("const")) return value.dump(-1);
  if (const Json& values = schema.get("enum"); values.is_array()) {
    std::vector<std::string> parts;
    for (const Json& value : values.elements()) parts.push_back(value.dump(-1));
    return (parts.size() > 1 ? "one of " : "") + joined(parts, ", ");
  }
  for (const char* key : {"anyOf", "oneOf"})
    if (const Json& alternatives = schema.get(key); alternatives.is_array()) return any_of_text(alternatives);
  const Json& type = schema.get("type");
  if (type.is_string()) return type_text(type.string(), schema);
  if (type.is_array()) {
    std::vector<std::string> parts;
    for (const Json& one : type.elements()) parts.push_back(type_text(one.string(), schema));
    return joined(parts, " or ");
  }
  for (const char* key : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "multipleOf"})
    if (schema.contains(key)) return type_text("number", schema);
  for (const char* key : {"items", "minItems", "maxItems", "uniqueItems", "contains"})
    if (schema.contains(key)) return type_text("array", schema);
  for (const char* key : {"pattern", "minLength", "maxLength"})
    if (schema.contains(key)) return type_text("string", schema);
  for (const char* key : {"properties", "required", "minProperties", "maxProperties"})
    if (schema.contains(key)) return type_text("object", schema);
  return "a value that the schema allows";
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string wanted_member_text(std::string_view unknown, const std::vector<std::string>& known) {
  if (known.empty()) return "no members";
  constexpr std::size_t longest_name = 100;  // no member of ours is longer
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, unknown.size() / 3) + 1;  // farther than that it is another word
  if (unknown.size() <= longest_name)
    for (const std::string& name : known)
      if (const std::size_t distance = edit_distance(unknown, name); distance < least) {
        least = distance;
        nearest = &name;
      }
  const std::string all = "one of " + joined(known, ", ");
  return nearest ? "perhaps \"" + *nearest + "\"; " + all : all;
}

}  // namespace gonio
