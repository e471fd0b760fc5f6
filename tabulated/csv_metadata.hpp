// SPDX-License-Identifier: BSD-3-Clause
// What a CSV file of ours says about its samples in the comment lines above them, so that CSV -> CSV loses nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "brdf/dataset.hpp"
#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {

/// First line of a file whose comment lines are to be believed. Other people's comments never are: "# symmetry: none" in a text is
/// prose.
constexpr std::string_view csv_signature = "# gonio samples 1";

/// Lines `# key: value`. Keys:
/// `channel` (its name; in the order of the columns), `channel.<name>.<field>` (wavelength_in_nm, wavelength_out_nm, bandwidth_nm,
/// polarisation_in, polarisation_out), `symmetry` (words), `side`, `simulated`, `aperture.<field>`, `correlated.<name>` (its u),
/// `masked.<reason>`, `extra` (name of a column kept as it came), `provenance.<key>`. `\\`, `\n`, `\r` and, in keys, `\:` are escapes.
struct CsvMetadata {
  bool ours = false;                ///< the signature was there
  Dataset description;              ///< everything of a data set but its samples
  std::vector<std::string> extras;  ///< columns that are neither angle nor channel nor uncertainty
};

/// Takes one line above the samples. An unknown key or a value that cannot be read is a fault.
void read_metadata_line(std::string_view line, std::size_t number, CsvMetadata& metadata, FaultList& faults);

/// Signature and lines, each with its end.
std::string metadata_lines(const Dataset& dataset);

}  // namespace gonio::tabulated
