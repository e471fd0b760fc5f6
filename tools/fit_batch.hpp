// SPDX-License-Identifier: BSD-3-Clause
// Many files, one fit and one JSON line each.
#pragma once

#include <string>
#include <vector>

#include "tools/fit_flags.hpp"

namespace gonio::tools {

struct BatchOptions {
  std::string out;       ///< JSON Lines file; empty: standard output
  bool resume = false;   ///< leave out what already stands in `out`
  bool ordered = false;  ///< lines in the order of the files instead of as they are done
  int jobs = 0;          ///< files at a time; 0: one for every processor
};

/// What stands in a folder as measurements: its files by name, subfolders, hidden files, files without ending, and .json, .jsonl, .md,
/// .log, .txt.gz and pictures left out. A name that is no folder stands for itself. Error(input) for a folder that cannot be listed.
std::vector<std::string> expand_folders(const std::vector<std::string>& names);

/// Fits every file on its own and gives a line for each (data-schemas/fit-line.schema.json): its fit, or its error. Only a wrong flag or
/// an output that cannot be written ends the rest.
///
/// Resuming leaves out a file if a line stands for the same bytes (SHA-256 of the file and of what else is read with it), the same
/// options and the same version, unless that line is an error of ours. The exit code is the worst over all lines, those that stood
/// included: 70 our own fault, 3 an input error, 1 a fit that did not converge, 0. SIGINT and SIGTERM let the running fits end and throw
/// Error(interrupted).
int fit_batch(const std::vector<std::string>& files, const FitRequest& request, const BatchOptions& options, Console& console);

}  // namespace gonio::tools
