// SPDX-License-Identifier: BSD-3-Clause
// What a reader of a written file gets, against what was to be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "data-schemas/json.hpp"
#include "tabulated/open.hpp"

namespace gonio::tools {

/// Relative differences |read - source|/|source| at 4000 pairs of directions, random but always the same, uniform in solid angle and not
/// closer than 10° to the horizon; all channels. Samples are read as every verb reads them, interpolated as their ratio to a guide that is
/// found anew from them: `guide` as TableFlags takes it. A source of one channel is compared with every channel of the file.
struct RoundTrip {
  std::size_t n = 0;           ///< values compared
  std::size_t n_left_out = 0;  ///< unknown in one of them, or not positive in the source
  double mean = 0, p95 = 0, largest = 0;
  std::string guide;  ///< the model between samples, `none`, or empty where none was interpolated
  double read_s = 0;  ///< to open the file and to evaluate it once
};

/// Reads `notes.files.front()` with the answers of the notes. Nothing, with the reason, where the file cannot be compared: no reader, other
/// channels, nothing to evaluate.
std::optional<RoundTrip> round_trip(const tabulated::Opened& source, const tabulated::ExportNotes& notes, const std::string& guide,
                                    int threads, std::string& reason);

Json round_trip_document(const std::optional<RoundTrip>& result, const std::string& reason);

}  // namespace gonio::tools
