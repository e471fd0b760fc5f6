// SPDX-License-Identifier: BSD-3-Clause
// Symmetries of a model or table that can be evaluated anywhere but carries no uncertainty.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fitting/checks/checks.hpp"

namespace gonio::fitting {

/// Whether everything in the subject has the property by construction.
bool holds_by_construction(const CheckSubject& subject, bool Symmetry::*property);

/// The k-th of a fixed sequence of pairs, even in solid angle up to 80° (additive recurrence of the plastic-number family), and a further
/// even number in [0, 1).
GonioAngles spread_pair(std::size_t k, double& number);

/// A relative difference that ought to be zero, with the same one some degrees away, where a table has other cells and so other noise.
struct TableDifference {
  double here = 0, nearby = 0;
  double weight = 1;
  GonioAngles angles;
  std::size_t channel = 0;
  double ratio = 1;
};

/// The verdict for values without uncertainties. The effect is the weighted rms of `here`, noise and all. What is shared with `nearby`,
/// √(mean here · nearby), holds no noise. Limits come from the scatter over blocks of the sequence (Student).
///   model: exact, so that anything beyond rounding warns and beyond the margin fails;
///   table: passes if the upper limit of the rms lies within the margin, fails if the lower limit of the shared part lies beyond.
void judge_table(Check& check, const std::vector<TableDifference>& differences, const std::string& tested, const CheckSubject& subject,
                 const CheckOptions& options);

/// The statistic of every symmetry of a table: 2 (f - f')/(|f| + |f'|) at spread pairs up to 80° and at their images (`image` gets the
/// angles and a number in [0, 1)), weighted by the projected solid angle cos θi cos θo; judged by judge_table().
void judge_by_evaluation(Check& check, const CheckSubject& subject, const CheckOptions& options,
                         const std::function<GonioAngles(const GonioAngles&, double)>& image);

}  // namespace gonio::fitting
