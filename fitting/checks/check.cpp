// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/check.hpp"

namespace gonio::fitting {

const char* name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::warn: return "warn";
    case Verdict::fail: return "fail";
    case Verdict::vacuous: return "vacuous";
    case Verdict::skipped: return "skipped";
  }
  return "skipped";
}

Verdict judge(bool significant, double effect, double effect_upper, double margin) noexcept {
  if (significant) return effect > margin ? Verdict::fail : Verdict::warn;
  return effect_upper <= margin ? Verdict::pass : Verdict::vacuous;
}

}  // namespace gonio::fitting
