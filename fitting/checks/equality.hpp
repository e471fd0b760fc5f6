// SPDX-License-Identifier: BSD-3-Clause
// The test behind reciprocity and isotropy: values that should be equal, in groups.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/checks/check.hpp"
#include "fitting/checks/checks.hpp"

namespace gonio::fitting {

struct EqualMember {
  double f = 0, u = 0;          ///< u NaN: unknown
  std::vector<double> shared;   ///< effect on f of one standard deviation of every shared component, the same order in every member
  std::vector<double> pattern;  ///< relative patterns of the directed tests
};
using EqualGroup = std::vector<EqualMember>;

struct EqualityTest {
  std::size_t groups = 0;
  bool has_uncertainty = false;
  double dof = 0, chi2 = 0, p_value = 1;
  double effect = 0, u_effect = 0, effect_upper = 0;  ///< relative; without uncertainty `effect` contains the noise
  int strongest = -1;  ///< the pattern with the largest amplitude in standard uncertainties if it is significant, else -1
};

/// Members of a group are equal but for their noise and the shared components. Generalised least squares: group means are free,
/// shared components have a unit-normal prior, so that a common scale or a tilt of known uncertainty is no asymmetry.
/// p-value: the smallest of χ² and the directed one-degree-of-freedom tests, times their number (Bonferroni).
/// Effect: τ of variance u² + τ² f² between members (moments, weighted towards precise groups), times `factor`; the amplitude of the
/// pattern where a directed test saw what χ² did not.
/// Groups with an unknown u are left out if any group has them all known.
EqualityTest test_equality(const std::vector<EqualGroup>& groups, double margin, double alpha, double factor);

/// Fills the numbers and the verdict of a check from the test; the caller writes the sentence.
void judge_equality(Check& check, const EqualityTest& test, const CheckOptions& options);

/// Fewer degrees of freedom than this cannot show equivalence: the moment estimate of the effect is not normal yet.
inline constexpr double enough_dof = 8;

}  // namespace gonio::fitting
