// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/check.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gonio::fitting {

constexpr double rounding = 1e-8;  // relative: below that digits are noise of the arithmetic

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

std::string percent_text(double relative) {
  if (!std::isfinite(relative)) return "unknown";
  if (relative != 0 && std::abs(relative) < rounding) return "less than 1e-6 %";
  return std::abs(relative) < 0.995 ? fmt::format("{:.2g} %", 100 * relative) : fmt::format("{:.0f} %", 100 * relative);
}

Verdict judge(bool significant, double effect, double effect_upper, double margin) noexcept {
  if (significant) return effect > margin ? Verdict::fail : Verdict::warn;
  return effect_upper <= margin ? Verdict::pass : Verdict::vacuous;
}

}  // namespace gonio::fitting
