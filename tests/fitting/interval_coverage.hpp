// SPDX-License-Identifier: BSD-3-Clause
// How often the intervals of a fit hold the truth over many draws of noise, and how far the values are from it.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "fitting/fit.hpp"
#include "fitting/threads.hpp"

namespace gonio::test {

/// One parameter over all draws.
struct ParameterCoverage {
  std::string name;
  double truth = 0;
  int held = 0, half_held = 0;  ///< draws whose two-sided interval holds the truth; the same with intervals of half the width
  double square = 0;            ///< sum of the squared deviations from the truth
};

struct Coverage {
  int draws = 0, converged = 0;
  std::vector<ParameterCoverage> parameters;

  double percent(const ParameterCoverage& p) const { return 100.0 * p.held / draws; }
  double half_percent(const ParameterCoverage& p) const { return 100.0 * p.half_held / draws; }
  double rmse(const ParameterCoverage& p) const { return std::sqrt(p.square / draws); }
  std::string text() const {
    std::string out;
    for (const ParameterCoverage& p : parameters)
      out += fmt::format("\n  {:8} {:g}: held in {:.1f} % of {} draws ({:.1f} % at half the width), rmse {:.3g}", p.name, p.truth,
                         percent(p), draws, half_percent(p), rmse(p));
    return out;
  }
};

/// Fits `draw(seed)` for seeds first, first + 1, …, two at a time with one thread each: the result does not depend on the threads.
inline Coverage coverage(const AnalyticBrdf& truth, unsigned first, int draws,
                         const std::function<std::shared_ptr<const Observations>(unsigned)>& draw) {
  fitting::FitOptions options;
  options.model = truth.model().name;
  options.threads = 1;
  std::vector<fitting::FitResult> results(static_cast<std::size_t>(draws));
  fitting::for_each_index(results.size(), 2,
                          [&](std::size_t k) { results[k] = fitting::fit(*draw(first + static_cast<unsigned>(k)), options); });
  Coverage out;
  out.draws = draws;
  for (const fitting::FittedParameter& p : results.front().parameters) {
    std::size_t k = 0;
    while (truth.model().parameters[k].name != p.name) ++k;
    out.parameters.push_back({p.channel ? fmt::format("{}[{}]", p.name, *p.channel) : p.name, truth.values()[p.channel.value_or(0)][k]});
  }
  for (const fitting::FitResult& result : results) {
    out.converged += result.status == fitting::Status::converged && result.parameters.size() == out.parameters.size();
    for (std::size_t k = 0; k < out.parameters.size() && k < result.parameters.size(); ++k) {
      const fitting::FittedParameter& p = result.parameters[k];
      ParameterCoverage& sum = out.parameters[k];
      sum.square += (p.value - sum.truth) * (p.value - sum.truth);
      if (!p.low || !p.high) continue;
      sum.held += *p.low <= sum.truth && sum.truth <= *p.high;
      sum.half_held += (*p.low + p.value) / 2 <= sum.truth && sum.truth <= (*p.high + p.value) / 2;
    }
  }
  return out;
}

/// The test: every draw converged, and the intervals of each of so many parameters held the truth in `fewest` to `most` per cent.
void require_coverage(const Coverage& found, std::size_t parameters, double fewest, double most);

}  // namespace gonio::test
