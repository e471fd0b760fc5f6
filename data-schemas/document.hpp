// SPDX-License-Identifier: BSD-3-Clause
// Loading and validating the documents of gonio, and the block that says where a result came from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/json.hpp"

namespace gonio {

/// Which schema of data-schemas/*.schema.json a document has to meet.
enum class Schema { bench, axis_profile, plan, fit, checks };

/// Every fault of the document against the schema, one per wrong place, `where` = `source` + `#` + JSON pointer, in document order.
/// Empty means valid. Faults that only repeat a fault of a child ("does not match") are dropped.
std::vector<Fault> faults_of(const Json& document, Schema schema, const std::string& source);

/// Reads, parses and validates; throws Error(input) with all faults at once.
Json load_document(const std::filesystem::path& path, Schema schema);

/// The text of a schema as built into the program.
std::string_view schema_text(Schema schema);
/// The SQL that makes a run store (data-schemas/run.sql).
std::string_view run_sql();

/// SHA-256 in lower-case hexadecimal.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);  ///< Error(input) if it cannot be read

/// An input of a result; the hash is computed on a second thread while the work runs.
struct HashedInput {
  std::string path;
  std::shared_future<std::string> sha256;
};
HashedInput hash_in_background(const std::filesystem::path& path);

/// The `context` block every JSON document starts with: program, version, build type, inputs with sha256, seed, `simulated`.
Json context(const std::vector<HashedInput>& inputs, std::optional<std::uint64_t> seed, bool simulated);

/// Writes a file whole or not at all: a temporary file beside it, fsync, rename. Error(input) if it cannot.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gonio
