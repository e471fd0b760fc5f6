// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <algorithm>

namespace gonio::fitting {

const std::vector<CheckEntry>& check_list() {
  static const std::vector<CheckEntry> list{
      {"reciprocity", &check_reciprocity}, {"isotropy", &check_isotropy}, {"energy", &check_energy}, {"positivity", &check_positivity}};
  return list;
}

std::vector<Check> run_checks(const CheckSubject& subject, const CheckOptions& options) {
  std::vector<Check> checks;
  for (const CheckEntry& entry : check_list()) checks.push_back(entry.run(subject, options));
  std::vector<Check*> tested;
  for (Check& check : checks)
    if (check.p_value) tested.push_back(&check);
  // Holm (1979): the k-th smallest p-value is held against alpha/(m-k+1); the first that does not pass ends the rejections.
  std::sort(tested.begin(), tested.end(), [](const Check* a, const Check* b) { return *a->p_value < *b->p_value; });
  bool rejecting = true;
  for (std::size_t k = 0; k < tested.size(); ++k) {
    Check& check = *tested[k];
    rejecting = rejecting && *check.p_value < options.alpha / static_cast<double>(tested.size() - k);
    const bool significant_alone = check.verdict == Verdict::fail || check.verdict == Verdict::warn;
    if (significant_alone && !rejecting) {
      check.verdict = judge(false, check.effect.value_or(0), check.effect_upper.value_or(0), check.threshold.value_or(0));
      check.detail += "; not significant among all the checks made";
    }
  }
  return checks;
}

}  // namespace gonio::fitting
