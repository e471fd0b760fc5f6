// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include "fitting/checks/multiple_tests.hpp"

namespace gonio::fitting {

const std::vector<CheckEntry>& check_list() {
  static const std::vector<CheckEntry> list{{"reciprocity", &check_reciprocity},
                                            {"isotropy", &check_isotropy},
                                            {"bilateral", &check_bilateral},
                                            {"energy", &check_energy},
                                            {"positivity", &check_positivity},
                                            {"monotonicity", &check_monotonicity},
                                            {"mirror_constancy", &check_mirror_constancy}};
  return list;
}

std::vector<Check> run_checks(const CheckSubject& subject, const CheckOptions& options) {
  std::vector<Check> checks;
  for (const CheckEntry& entry : check_list()) checks.push_back(entry.run(subject, options));
  std::erase_if(checks, [](const Check& check) { return check.verdict == Verdict::skipped; });
  std::vector<std::size_t> tested;
  std::vector<double> p;
  for (std::size_t k = 0; k < checks.size(); ++k)
    if (checks[k].p_value) tested.push_back(k), p.push_back(*checks[k].p_value);
  const std::vector<double> adjusted = holm(p);
  for (std::size_t k = 0; k < tested.size(); ++k) {
    Check& check = checks[tested[k]];
    const bool significant_alone = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
    if (significant_alone && adjusted[k] >= options.alpha) {
      check.verdict = judge(false, check.effect.value_or(0), check.effect_upper.value_or(0), check.threshold.value_or(0));
      check.detail += "; not significant among all the checks made";
    }
  }
  return checks;
}

}  // namespace gonio::fitting
