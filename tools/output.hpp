// SPDX-License-Identifier: BSD-3-Clause
// Result documents and output formats shared by the verbs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "fitting/checks/check.hpp"
#include "fitting/not_fitted.hpp"
#include "tabulated/open.hpp"

namespace gonio::tools {

/// The names of the formats that can be written, comma separated.
std::string writable_formats();
/// Error(usage) if there is no such format or it is read only.
const tabulated::Format& writable_format(const std::string& name);
/// The format an output name asks for: `.csv`, `.brdf.exr`, `.binary`. Error(usage) otherwise.
const tabulated::Format& format_of_name(const std::string& out);

Json masked_document(const MaskedCounts& masked);
/// The same with what a fit left out of what was read.
Json masked_document(const MaskedCounts& masked, const fitting::NotFitted& not_fitted);
/// Both for people, `masked: 12 NaN, 3 below the horizon`; empty if nothing was left out. Cells marked in a table were counted as missing
/// when it was read, and are told once.
std::string masked_text(const MaskedCounts& masked, const fitting::NotFitted& not_fitted);

/// A value, or null where there is none.
template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// The document of `gonio check` (data-schemas/checks.schema.json).
Json checks_document(const std::vector<fitting::Check>& checks, Json context);
/// Its member `checks`.
Json checks_array(const std::vector<fitting::Check>& checks);

/// The same for people, one line per check and per place that violates.
std::vector<std::string> check_lines(const std::vector<fitting::Check>& checks);

}  // namespace gonio::tools
