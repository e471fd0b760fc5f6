// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/table_symmetry.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

constexpr double far_below = 3;  // standard uncertainties
constexpr std::size_t evaluated_pairs = 65536;

struct Counts {
  std::size_t with_u = 0, significant = 0;  ///< values with a known u, and those of them below -3u
  std::size_t values = 0, negative = 0;
  double lowest_z = 0, lowest = 0;

  void add(double f, double u) {
    if (!std::isfinite(f)) return;
    ++values;
    negative += f < 0;
    lowest = std::min(lowest, f);
    if (!(u > 0) || !std::isfinite(u)) return;
    ++with_u;
    significant += f < -far_below * u;
    lowest_z = std::min(lowest_z, f / u);
  }
};

void count(const Observations& observations, Counts& counts) {
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    for (std::size_t k = 0; k < block.size; ++k) {
      if (!block.valid(k)) continue;
      for (std::size_t c = 0; c < block.f.size(); ++c) counts.add(block.f[c][k], block.u.empty() ? std::nan("") : block.u[c][k]);
    }
  }
}

bool negative_means_no_value(const Observations& observations) {
  return observations.block_count() > 0 && observations.block(0).validity == ObservationBlock::Validity::no_channel_negative;
}

void judge_evaluated(Check& check, const Brdf& brdf) {
  Counts counts;
  for (std::size_t k = 0; k < evaluated_pairs; ++k) {
    double number = 0;
    const GonioAngles angles = spread_pair(k, number);
    for (const double f : brdf.eval(angles.wi(), angles.wo())) counts.add(f, std::nan(""));
  }
  check.n = counts.values;
  check.effect = counts.values > 0 ? static_cast<double>(counts.negative) / static_cast<double>(counts.values) : 0;
  check.verdict = counts.negative == 0 ? Verdict::pass : *check.effect > *check.threshold ? Verdict::fail : Verdict::warn;
  check.detail =
      fmt::format("{} of {} evaluated values are negative, the lowest {:.3g} 1/sr", counts.negative, counts.values, counts.lowest);
}

}  // namespace

Check check_positivity(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "positivity";
  check.unit = "part of the values";
  check.threshold = options.margin;
  Counts counts;
  for (const auto& dataset : subject.datasets) count(*observe(dataset), counts);
  if (subject.datasets.empty() && subject.observations) {
    if (negative_means_no_value(*subject.observations)) {
      check.verdict = Verdict::vacuous;
      check.detail = "in this format a negative value marks a cell without a measurement, so none can be seen";
      return check;
    }
    count(*subject.observations, counts);
  } else if (subject.datasets.empty() && subject.brdf) {
    judge_evaluated(check, *subject.brdf);
    return check;
  }
  check.n = counts.with_u > 0 ? counts.with_u : counts.values;
  if (counts.values == 0) {
    check.verdict = Verdict::vacuous;
    check.detail = "there are no values";
    return check;
  }
  if (counts.with_u == 0) {
    check.effect = static_cast<double>(counts.negative) / static_cast<double>(counts.values);
    check.verdict = counts.negative == 0 ? Verdict::pass : Verdict::vacuous;
    check.detail =
        counts.negative == 0
            ? fmt::format("none of {} values is negative", counts.values)
            : fmt::format("{} of {} values are negative, the lowest {:.3g} 1/sr, but without uncertainties nothing tells this from noise",
                          counts.negative, counts.values, counts.lowest);
    return check;
  }
  // Too many values below -3u, or a single one too far below: the smaller p-value, doubled for the choice.
  const double expected_part = normal_upper_tail(far_below);
  const auto n = static_cast<double>(counts.with_u);
  const double too_many = binomial_upper_tail(counts.significant, counts.with_u, expected_part);
  const double too_far = -std::expm1(n * std::log1p(-normal_upper_tail(-counts.lowest_z)));
  check.statistic = static_cast<double>(counts.significant);
  check.p_value = std::min(1.0, 2 * std::min(too_many, too_far));
  check.effect = std::max(0.0, static_cast<double>(counts.significant) / n - expected_part);
  check.u_effect = std::sqrt(std::max(expected_part, static_cast<double>(counts.significant) / n) / n);
  check.effect_upper = std::max(0.0, binomial_upper_limit(counts.significant, counts.with_u, options.alpha) - expected_part);
  check.verdict = judge(*check.p_value < options.alpha, *check.effect, *check.effect_upper, options.margin);
  check.detail = fmt::format("{} of {} values lie more than 3 standard uncertainties below zero ({:.2g} expected from noise){}",
                             counts.significant, counts.with_u, n * expected_part,
                             counts.lowest_z < 0 ? fmt::format(", the lowest {:.1f} below", -counts.lowest_z) : ", none below zero at all");
  if (check.verdict == Verdict::vacuous)
    check.detail += fmt::format("; {} values cannot tell within {:.2g} %", counts.with_u, 100 * options.margin);
  return check;
}

}  // namespace gonio::fitting
