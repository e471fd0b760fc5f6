// SPDX-License-Identifier: BSD-3-Clause
// From contrasts to a verdict: the test, the tilt taken out of it, noise that was understated, and the places that stand out.
#pragma once

#include <optional>
#include <string>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/contrasts.hpp"
#include "fitting/checks/repeatability.hpp"

namespace gonio::fitting {

/// The words that differ between symmetries.
struct SymmetryWords {
  std::string what;       ///< "reciprocity": what a tilt is not
  std::string tested;     ///< "40 partner pairs", "24 poses"
  std::string effect;     ///< "difference", "variation between azimuths"
  std::string statistic;  ///< "chi²/n", "Q/dof"
  std::string advice;     ///< after the name of the directed pattern that stands out; may be empty
};

/// Tests contrasts and writes verdict, numbers, sentence and places. If the test is significant, a tilt of the normal
/// is estimated against the model fitted to the subject's first data set: where the data agree once it is taken out, the verdict is
/// `warn` and the sentence calls it a tilt. Where only the noise is understated the verdict is `warn` too and says so. Data without
/// uncertainties: judge_without_uncertainty().
void judge_symmetry(Check& check, const Contrasts& set, const std::optional<Repeatability>& repeatability, const CheckSubject& subject,
                    const CheckOptions& options, const SymmetryWords& words);

}  // namespace gonio::fitting
