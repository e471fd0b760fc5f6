// SPDX-License-Identifier: BSD-3-Clause
// Schemas with every reference replaced by what it refers to.
#pragma once

#include <string>
#include <string_view>

#include "data-schemas/json.hpp"

namespace gonio {

/// The built-in schema file with each `$ref` replaced by its target: `#/definitions/x`, `context.schema.json` or
/// `context.schema.json#/definitions/x`. Nothing is ever fetched. As in draft 7, what stands beside a `$ref` does not count.
/// Error(internal) for a target that does not exist and for a schema that refers to itself.
Json expanded_schema(const std::string& file_name);

/// The same for a schema given as text; its own `#/...` references are resolved within it.
Json expanded_schema_text(std::string_view text, const std::string& name);

}  // namespace gonio
