// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/table_symmetry.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace gonio::fitting {
namespace {

constexpr std::size_t pairs = 4096;

}  // namespace

bool holds_by_construction(const CheckSubject& subject, bool Symmetry::*property) {
  bool any = false, all = true;
  const auto ask = [&](const Symmetry& symmetry) { any = true, all = all && symmetry.*property; };
  for (const auto& dataset : subject.datasets) ask(dataset->symmetry);
  if (subject.datasets.empty()) {
    if (subject.observations) ask(subject.observations->symmetry());
    if (subject.brdf) ask(subject.brdf->symmetry());
  }
  return any && all;
}

GonioAngles spread_pair(std::size_t k, double& number) {
  // Roberts' generalised golden ratio for five dimensions: g^6 = g + 1.
  constexpr double g = 1.1347241384015194;
  std::array<double, 5> x{};
  double power = 1;
  for (double& value : x) {
    power /= g;
    value = std::fmod(0.5 + static_cast<double>(k + 1) * power, 1.0);
  }
  const double low = std::cos(80 * std::numbers::pi / 180);
  const auto zenith = [&](double v) { return radians(std::acos(low + (1 - low) * v)); };
  number = x[4];
  return {zenith(x[0]), radians(2 * std::numbers::pi * x[1]), zenith(x[2]), radians(2 * std::numbers::pi * x[3])};
}

void describe_by_evaluation(Check& check, const CheckSubject& subject,
                            const std::function<GonioAngles(const GonioAngles&, double)>& image) {
  check.verdict = Verdict::vacuous;
  check.unit = "relative";
  if (!subject.brdf) {
    check.detail = "a table is tested through its interpolation, which was not given";
    return;
  }
  double square = 0, mean2 = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    double number = 0;
    const GonioAngles angles = spread_pair(k, number), other = image(angles, number);
    const auto a = subject.brdf->eval(angles.wi(), angles.wo()), b = subject.brdf->eval(other.wi(), other.wo());
    for (std::size_t c = 0; c < a.size(); ++c) {
      if (!std::isfinite(a[c]) || !std::isfinite(b[c])) continue;
      square += (a[c] - b[c]) * (a[c] - b[c]);
      mean2 += 0.25 * (a[c] + b[c]) * (a[c] + b[c]);
      ++check.n;
    }
  }
  check.effect = mean2 > 0 ? std::sqrt(square / mean2) : 0;
  check.detail = fmt::format("{} pairs differ by {:.2g} % (rms), but a table without uncertainties cannot tell this from noise", check.n,
                             100 * *check.effect);
}

}  // namespace gonio::fitting
