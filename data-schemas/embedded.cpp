// SPDX-License-Identifier: BSD-3-Clause
// Look-up of the built-in texts; the list itself is written by CMake (embed.cmake).
#include "data-schemas/embedded.hpp"

#include <string>

#include "brdf/error.hpp"
#include "data-schemas/embedded_files.hpp"

namespace gonio {
namespace {

std::string_view text_of(std::string_view path) {
  for (const EmbeddedFile& file : embedded_files())
    if (file.path == path) return file.text;
  return {};
}

std::vector<std::string_view> names_in(std::string_view folder, std::string_view ending) {
  std::vector<std::string_view> names;
  for (const EmbeddedFile& file : embedded_files())
    if (file.path.starts_with(folder)) {
      names.push_back(file.path.substr(folder.size()));
      names.back().remove_suffix(ending.size());
    }
  return names;
}

std::string_view required(std::string_view path) {
  const std::string_view text = text_of(path);
  if (text.empty()) throw Error(ErrorKind::internal, {"built-in files", "no " + std::string(path), "data-schemas/" + std::string(path)});
  return text;
}

constexpr std::string_view examples = "examples/valid/", profiles = "axis-profiles/", json = ".json";

}  // namespace

const char* name(Schema schema) noexcept {
  switch (schema) {
    case Schema::bench: return "bench";
    case Schema::axis_profile: return "axis-profile";
    case Schema::plan: return "plan";
    case Schema::fit: return "fit";
    case Schema::checks: return "checks";
    case Schema::tradeoff: return "tradeoff";
    case Schema::fit_line: return "fit-line";
    case Schema::choice: return "choice";
    case Schema::compare: return "compare";
    case Schema::statistics: return "statistics";
    case Schema::bird_brdf: return "bird-brdf";
    case Schema::export_files: return "export";
    case Schema::openmaterial_brdf: return "openmaterial-brdf";
  }
  return "";
}

std::string_view schema_text(Schema schema) { return required(std::string(name(schema)) + ".schema.json"); }
std::string_view schema_file_text(std::string_view file_name) {
  return file_name.ends_with(".schema.json") ? text_of(file_name) : std::string_view();
}
std::string_view run_sql() { return required("run.sql"); }
std::string_view example_text(std::string_view name) { return text_of(std::string(examples).append(name)); }
std::string_view axis_profile_text(std::string_view name) { return text_of(std::string(profiles).append(name).append(json)); }
std::vector<std::string_view> example_names() { return names_in(examples, ""); }
std::vector<std::string_view> axis_profile_names() { return names_in(profiles, json); }

}  // namespace gonio
