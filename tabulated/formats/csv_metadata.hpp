// SPDX-License-Identifier: BSD-3-Clause
// What a CSV file of ours says about its samples in the comment lines above them, so that CSV -> CSV loses nothing.
#pragma once

#include <string>
#include <string_view>

#include "tabulated/fault_list.hpp"
#include "tabulated/formats/metadata.hpp"

namespace gonio::tabulated {

/// First line of a file whose comment lines are to be believed. Other people's comments never are: "# symmetry: none" in a text is
/// prose.
constexpr std::string_view csv_signature = "# gonio samples 1";

/// Lines `# key: value` with the keys of `metadata_entries`; `\\`, `\n`, `\r` and, in keys, `\:` are escapes.
struct CsvMetadata : Metadata {
  bool ours = false;  ///< the signature was there
};

/// Takes one line above the samples. An unknown key or a value that cannot be read is a fault.
void read_metadata_line(std::string_view line, std::size_t number, CsvMetadata& metadata, FaultList& faults);

/// Signature and lines, each with its end.
std::string metadata_lines(const Dataset& dataset);

}  // namespace gonio::tabulated
