// SPDX-License-Identifier: BSD-3-Clause
// The checks of a BRDF's physics, as statistics (alpha = 1 % per check, Holm over checks, margin 2 % unless told otherwise).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/observations.hpp"
#include "fitting/checks/check.hpp"

namespace gonio::fitting {

struct CheckOptions {
  double margin = 0.02;
  double alpha = 0.01;
  /// Rotation of the sample for each data set given (degrees); empty: taken from the data's own rotated pairs.
  std::vector<double> rotation_deg;
};

/// What is checked: one or several data sets (the same sample rotated), a table as observations, or a model.
struct CheckSubject {
  std::vector<std::shared_ptr<const Dataset>> datasets;
  std::shared_ptr<const Observations> observations;  ///< a table that is not a data set (MERL)
  std::shared_ptr<const Brdf> brdf;                  ///< for energy of tables and models
};

struct CheckEntry {
  const char* id;
  Check (*run)(const CheckSubject&, const CheckOptions&);
};

/// Every check: reciprocity, isotropy, energy, positivity. A new check is one file and one line in the list.
const std::vector<CheckEntry>& check_list();

/// Runs the whole list and applies Holm's correction over the checks that have a p-value.
std::vector<Check> run_checks(const CheckSubject& subject, const CheckOptions& options);

}  // namespace gonio::fitting
