// SPDX-License-Identifier: BSD-3-Clause
// Samples on their way to a renderer: the guide, the table, what is masked, imposed and extrapolated.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data-schemas/json.hpp"
#include "tabulated/imposed_symmetry.hpp"
#include "tabulated/open.hpp"
#include "tools/console.hpp"

namespace gonio::tools {

/// The flags of verbs that make tables of samples.
struct TableFlags {
  std::string guide = "auto", extrapolate = "model", impose;
  double mask_retro_deg = 0;
  bool resample = false;

  void add_to(CLI::App& app);
  /// What --impose names. Error(usage) for anything else.
  Symmetry imposed() const;
};

/// A guide that was tried.
struct TriedGuide {
  std::string name;  ///< a model, `none`, or a file
  std::string parameters;
  double alone = 0, incidence = 0;  ///< InterpolationError::mean_alone and mean_incidence with it; NaN where it cannot be told
};

/// What became of samples or a table before it was written.
struct TableReport {
  std::vector<TriedGuide> guides;  ///< the one that was taken first; empty: nothing was interpolated
  std::size_t n_samples = 0, n_masked_retro = 0, n_left_out = 0;
  bool extrapolated = false;
  bool noise_estimated = false;  ///< the samples state no uncertainty
  std::vector<std::pair<std::string, tabulated::SymmetryChange>> imposed;
};

/// Replaces the interpolation of samples by a GuidedTable and imposes symmetry, as the flags say; with --resample or --impose the samples
/// themselves are left out of the result, so that every format gets the table. Sources without samples are only imposed upon.
/// `--guide auto` fits a few models under two metrics and takes what predicts left-out samples best, which may be no model at all.
tabulated::Opened measured_table(const tabulated::Opened& source, const TableFlags& flags, int threads, TableReport& report);

Json table_document(const TableReport& report);
std::vector<std::string> table_lines(const TableReport& report);

}  // namespace gonio::tools
