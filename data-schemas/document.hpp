// SPDX-License-Identifier: BSD-3-Clause
// Loading and validating the documents of gonio, and the block that says where a result came from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/embedded.hpp"
#include "data-schemas/json.hpp"
#include "data-schemas/sha256.hpp"
#include "data-schemas/write_file.hpp"

namespace gonio {

/// Every fault of the document against the schema, one per wrong place, `where` = `source` + `#` + JSON pointer, in document order.
/// Empty means valid. A missing member is a fault of its object. Where alternatives are allowed (`anyOf`, `oneOf`), the faults are
/// those of the alternative that was meant; a fault that only repeats one of a child ("does not match") does not appear.
std::vector<Fault> faults_of(const Json& document, Schema schema, const std::string& source);
/// The same against a schema given as text (JSON Schema draft 7). Error(internal) if that is no schema.
std::vector<Fault> faults_of(const Json& document, std::string_view schema, const std::string& source);

/// Reads, parses and validates; throws Error(input) with all faults at once.
Json load_document(const std::filesystem::path& path, Schema schema);

/// A file's bytes; Error(input) if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// The `context` block every JSON document starts with: program, version, build type, inputs with sha256 (waits for the hashes),
/// seed (null where nothing was random), and whether the data, or any of them, come from a simulated bench.
Json context(const std::vector<HashedInput>& inputs, std::optional<std::uint64_t> seed, bool simulated);

}  // namespace gonio
