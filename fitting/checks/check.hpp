// SPDX-License-Identifier: BSD-3-Clause
// The one result type of every check, and the rule that turns a statistic into a verdict.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gonio::fitting {

/// pass: equivalent within the margin. warn: significant only. fail: significant and beyond the margin.
/// vacuous: the data cannot tell, with the reason. skipped: not asked for or not applicable.
enum class Verdict { pass, warn, fail, vacuous, skipped };
const char* name(Verdict verdict) noexcept;

struct Check {
  std::string id;  ///< reciprocity, isotropy, energy, positivity, energy_bound, ...
  Verdict verdict = Verdict::skipped;
  std::optional<double> statistic, p_value;  ///< none where the check is no test of a hypothesis
  std::optional<double> effect;              ///< size of the effect in `unit`
  std::optional<double> u_effect;            ///< its standard uncertainty
  std::optional<double> effect_upper;        ///< upper confidence limit of the effect, held against `threshold` for `pass`
  std::string unit;
  std::optional<double> threshold;  ///< margin or limit the effect is held against
  std::size_t n = 0;                ///< what was tested: pairs, incidences, samples
  std::string detail;               ///< one sentence a person understands
};

/// The rule of every test: significant and beyond the margin fails, significant alone warns; not significant passes only if the upper
/// confidence limit of the effect lies within the margin too (equivalence), else the data cannot tell.
Verdict judge(bool significant, double effect, double effect_upper, double margin) noexcept;

}  // namespace gonio::fitting
