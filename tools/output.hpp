// SPDX-License-Identifier: BSD-3-Clause
// Result documents and output formats shared by the verbs.
#pragma once

#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "fitting/checks/check.hpp"
#include "fitting/fit.hpp"
#include "tabulated/open.hpp"

namespace gonio::tools {

/// The names of the formats that can be written, comma separated.
std::string writable_formats();
/// Error(usage) if there is no such format or it is read only.
const tabulated::Format& writable_format(const std::string& name);
/// The format an output name asks for: `.csv`, `.brdf.exr`, `.binary`. Error(usage) otherwise.
const tabulated::Format& format_of_name(const std::string& out);

Json masked_document(const MaskedCounts& masked);

/// Seconds spent, as `timings_s` of a fit prints them.
struct FitTimings {
  double read_s = 0, fit_s = 0, total_s = 0;
};
/// The document of `gonio fit` (data-schemas/fit.schema.json); `options` are the flags that shaped the result, null: none given.
Json fit_document(const fitting::FitResult& result, const MaskedCounts& masked, const FitTimings& timings, Json context, Json options = {});
/// The document of `gonio check` (data-schemas/checks.schema.json).
Json checks_document(const std::vector<fitting::Check>& checks, Json context);

/// The same for people, one line per parameter, metric and check.
std::vector<std::string> fit_lines(const fitting::FitResult& result);
std::vector<std::string> check_lines(const std::vector<fitting::Check>& checks);

}  // namespace gonio::tools
