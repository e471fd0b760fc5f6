// SPDX-License-Identifier: BSD-3-Clause
// The texts of data-schemas/ that are built into the program, so that it needs no files of its own at run time.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace gonio {

/// Which schema of data-schemas/*.schema.json a document has to meet.
enum class Schema {
  bench,
  axis_profile,
  plan,
  fit,
  checks,
  tradeoff,
  fit_line,
  choice,
  compare,
  statistics,
  bird_brdf,
  openmaterial_brdf,
  export_files
};
inline constexpr std::array every_schema{Schema::bench,       Schema::axis_profile, Schema::plan,      Schema::fit,
                                         Schema::checks,      Schema::tradeoff,     Schema::fit_line,  Schema::choice,
                                         Schema::compare,     Schema::statistics,   Schema::bird_brdf, Schema::openmaterial_brdf,
                                         Schema::export_files};
constexpr std::size_t schema_count = every_schema.size();

/// The first part of the schema's file name, and the middle part of its examples': `bench`, `axis-profile`, `fit-line`, ...
const char* name(Schema schema) noexcept;

/// The text of a schema.
std::string_view schema_text(Schema schema);
/// The text of any schema file by its name, e.g. `context.schema.json`; empty if there is none. References between schemas are file names.
std::string_view schema_file_text(std::string_view file_name);
/// The SQL that makes a run store (data-schemas/run.sql).
std::string_view run_sql();
/// A valid example document by its file name, e.g. `demo.bench.json`; empty if there is none.
std::string_view example_text(std::string_view name);
/// A built-in axis profile by its name without ending, e.g. `cia402`; empty if there is none.
std::string_view axis_profile_text(std::string_view name);

/// File names of all built-in examples, sorted.
std::vector<std::string_view> example_names();
/// Names of all built-in axis profiles, sorted.
std::vector<std::string_view> axis_profile_names();

}  // namespace gonio
