// SPDX-License-Identifier: BSD-3-Clause
// Reading one or more files and fitting what they hold: one line of a batch, or the whole verb.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "data-schemas/sha256.hpp"
#include "tools/fit_document.hpp"
#include "tools/fit_flags.hpp"

namespace gonio::tools {

/// The measurements of some files, read.
struct FitInput {
  std::vector<std::shared_ptr<const Observations>> parts;  ///< one per file
  MaskedCounts masked;                                     ///< of all files
  bool simulated = false;                                  ///< any of them is
  double read_s = 0;
};
/// Error(input) with the faults of every file that cannot be read or is a model; notes on the console what is no measurement.
FitInput read_inputs(const std::vector<std::string>& files, const tabulated::ReadOptions& options, const Console& console);

/// What a fit of these files depends on: themselves, the sidecars of MERL tables (`.binary`) where they stand, and the blank.
std::vector<HashedInput> hash_inputs(const std::vector<std::string>& files, const tabulated::ReadOptions& options);

struct FitOutcome {
  fitting::FitResult result;
  FitTimings timings;
};
/// Fits all parts together.
FitOutcome fit_input(const FitInput& input, const fitting::FitOptions& options);

}  // namespace gonio::tools
