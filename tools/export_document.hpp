// SPDX-License-Identifier: BSD-3-Clause
// What a writer noted about the file it wrote, as a document and as lines for people.
#pragma once

#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/export_notes.hpp"

namespace gonio::tools {

/// Members `files`, `n_nodes`, `n_below_horizon`, `n_unknown`, `n_negative`, `n_extrapolated`, `facts` and `lost`.
Json notes_document(const tabulated::ExportNotes& notes);
/// Facts, counts that are not 0, and what was lost; one line each.
std::vector<std::string> notes_lines(const tabulated::ExportNotes& notes);

}  // namespace gonio::tools
