// SPDX-License-Identifier: BSD-3-Clause
// Resolving references between the built-in schemas.
#include "data-schemas/schema_reference.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/embedded.hpp"

namespace gonio {
namespace {

class Expansion {
 public:
  void add(const std::string& name, std::string_view text) { documents_.emplace(name, parse_json(text, name)); }

  /// The schema with its references resolved; `file` is the document that `#/...` means.
  Json expand(const Json& schema, const std::string& file) {
    if (schema.is_array()) {
      Json result = Json::array();
      for (const Json& element : schema.elements()) result.push_back(expand(element, file));
      return result;
    }
    if (!schema.is_object()) return schema;
    if (const Json& reference = schema.get("$ref"); reference.is_string()) return target(reference.string(), file);
    Json result = Json::object();
    for (const auto& [name, member] : schema.members())
      // Definitions have been put in where they are used; $id would give references another base.
      if (name != "definitions" && name != "$id" && name != "$schema") result.set(name, expand(member, file));
    return result;
  }

  const Json& document(const std::string& name) {
    if (!documents_.contains(name)) {
      const std::string_view text = schema_file_text(name);
      if (text.empty()) throw Error(ErrorKind::internal, {name, "no such schema", "a file of data-schemas/"});
      add(name, text);
    }
    return documents_.at(name);
  }

 private:
  Json target(const std::string& reference, const std::string& from) {
    const std::size_t hash = std::min(reference.find('#'), reference.size());
    const std::string file = hash == 0 ? from : reference.substr(0, hash);
    const std::string full = file + reference.substr(hash);
    if (std::find(open_.begin(), open_.end(), full) != open_.end())
      throw Error(ErrorKind::internal, {full, "a schema that refers to itself", "references without a circle"});
    open_.push_back(full);
    const Json* node = &document(file);
    for (std::size_t at = hash + 1; at < reference.size();) {
      const std::size_t end = std::min(reference.find('/', at + 1), reference.size());
      node = &node->get(reference.substr(at + 1, end - at - 1));
      at = end;
    }
    if (node->is_null()) throw Error(ErrorKind::internal, {full, "nothing", "a schema"});
    Json result = expand(*node, file);
    open_.pop_back();
    return result;
  }

  std::map<std::string, Json> documents_;
  std::vector<std::string> open_;  ///< references being resolved
};

}  // namespace

Json expanded_schema(const std::string& file_name) {
  Expansion expansion;
  return expansion.expand(expansion.document(file_name), file_name);
}

Json expanded_schema_text(std::string_view text, const std::string& name) {
  Expansion expansion;
  expansion.add(name, text);
  return expansion.expand(expansion.document(name), name);
}

}  // namespace gonio
