// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a bench document.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/json.hpp"

namespace gonio::acquisition {

/// Every fault against the schema and every contradiction between members that a schema cannot say; profiles are read and checked too.
/// Looks only at members that are there and of their type, so that one missing member does not hide the other faults.
std::vector<Fault> bench_faults(const Json& document, const std::filesystem::path& folder, const std::string& source);

/// The document with profiles that it names by file put in their place and file names made absolute: it can be read anywhere.
/// The document has no faults.
Json self_contained(const Json& document, const std::filesystem::path& folder);

}  // namespace gonio::acquisition
