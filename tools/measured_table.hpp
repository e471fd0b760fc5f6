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
  /// `extrapolate` empty: as `model`, but no table of which most would be extrapolated (require_covered).
  std::string guide = "auto", extrapolate, impose;
  double mask_retro_deg = 0;
  bool resample = false;

  void add_to(CLI::App& app);
  /// Those that say what lies between the samples, for verbs that write no table.
  void add_interpolation_to(CLI::App& app);
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
  /// Part of all pairs of directions, in projected solid angle of both, that lies beyond the samples; 0 if nothing was interpolated.
  double beyond = 0;
  std::optional<double> one_azimuth_deg;  ///< the light came from this azimuth alone, and the samples are not isotropic by a statement
  bool noise_estimated = false;           ///< the samples state no uncertainty
  std::vector<std::pair<std::string, tabulated::SymmetryChange>> imposed;
};

/// Replaces the interpolation of samples by a GuidedTable and imposes symmetry, as the flags say; with --resample or --impose the samples
/// themselves are left out of the result, so that every format gets the table. Sources without samples are only imposed upon.
/// `--guide auto` fits a few models under two metrics and takes what predicts left-out samples best, which may be no model at all.
tabulated::Opened measured_table(const tabulated::Opened& source, const TableFlags& flags, int threads, TableReport& report);

/// Whether `source` is samples without a table of their own: between them `measured_table` knows more than their nearest ones say.
bool is_scattered(const tabulated::Opened& source);

/// One line on a table of samples for standard error: the guide, and how well samples are predicted. Empty: nothing was interpolated.
std::string interpolation_line(const TableReport& report);

/// What to know before anything is made of the samples: that most of it would be guesses, and what to do. Empty: nothing.
std::string coverage_warning(const TableReport& report);
/// Error(input) if most of a table would be extrapolated and nobody has asked for that: it would look measured and be a guess.
void require_covered(const std::string& where, const TableFlags& flags, const TableReport& report);

Json table_document(const TableReport& report);
std::vector<std::string> table_lines(const TableReport& report);

}  // namespace gonio::tools
