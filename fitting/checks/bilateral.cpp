// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/paired_places.hpp"
#include "fitting/checks/repeatability.hpp"
#include "fitting/checks/symmetry_verdict.hpp"
#include "fitting/checks/table_symmetry.hpp"

namespace gonio::fitting {

Check check_bilateral(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "bilateral";
  check.unit = "relative";
  check.threshold = options.margin;
  if (holds_by_construction(subject, &Symmetry::bilateral)) {
    check.verdict = Verdict::vacuous;
    check.detail = "cannot fail: it holds by construction of the data or the model, so nothing was tested";
    return check;
  }
  if (subject.datasets.empty()) {
    judge_by_evaluation(check, subject, options, [](const GonioAngles& angles, double) { return mirrored(angles); });
    return check;
  }
  const Contrasts pairs = mirror_pairs(subject.datasets);
  if (pairs.contrasts.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = "no sample has its mirror image on the other side of the plane of incidence";
    return check;
  }
  judge_symmetry(check, pairs, repeated_readings(subject.datasets), subject, options,
                 {"bilateral symmetry", fmt::format("{} mirror pairs", pairs.contrasts.size()), "difference", "chi²/n", ""});
  // A beam, detector or mount that is off to one side does the same, and stays so when the sample turns.
  if (check.verdict == Verdict::fail) check.verdict = Verdict::warn;
  if (check.verdict == Verdict::warn)
    check.detail += "; mirror pairs inside one file may differ by the instrument as well as by the sample: turn the sample to tell";
  return check;
}

}  // namespace gonio::fitting
