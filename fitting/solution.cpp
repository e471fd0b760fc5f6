// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/solution.hpp"

#include <cmath>

#include "fitting/polish.hpp"

namespace gonio::fitting {
namespace {

constexpr int reweighting_rounds = 3;  // the weights have settled to 1e-6 by then (numerics C13)

std::vector<std::vector<double>> linear_of(const ProfilePoint& point) {
  std::vector<std::vector<double>> linear;
  for (const ChannelPart& part : point.channel) linear.push_back(part.x);
  return linear;
}

}  // namespace

Solution solve(Terms& terms, const SolveOptions& options, const std::vector<CorrelatedComponent>& correlated) {
  const bool scanned = terms.kernel.nonlinear > 0 && std::isnan(options.held_s);
  Solution solution;
  for (int round = 0;; ++round) {
    const Profile profile(terms, options.held);
    std::vector<ProfilePoint> scan;
    std::vector<Minimum> minima;
    if (scanned) {
      scan = profile.scan(options.threads);
      minima = profile.minima(scan);
    } else {
      minima.push_back({0, profile.at(terms.kernel.nonlinear > 0 ? options.held_s : 1)});
    }
    if (!std::isfinite(minima.front().point.cost)) {
      solution.reason = "the cost is not finite anywhere on the scan";
      return solution;
    }
    if (round < reweighting_rounds && reweight(terms, linear_of(minima.front().point), minima.front().point.s)) continue;

    std::vector<OtherSolution> found;
    solution.converged = true;
    for (const Minimum& minimum : minima) {
      OtherSolution other{linear_of(minimum.point), minimum.point.s, minimum.point.cost};
      if (!terms.transform.linear()) {
        const Polished polished = polish(terms, other.linear, other.s, options.held, !scanned, options.threads);
        if (polished.converged && polished.cost <= other.cost) other = {polished.linear, polished.s, polished.cost};
        if (!polished.converged && found.empty()) {
          solution.converged = false;
          solution.reason = "the solver stopped before it converged: " + polished.reason;
        }
      }
      found.push_back(std::move(other));
    }
    std::size_t best = 0;
    for (std::size_t k = 1; k < found.size(); ++k)
      if (found[k].cost < found[best].cost) best = k;
    solution.linear = found[best].linear;
    solution.s = found[best].s;
    solution.cost = found[best].cost;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (k != best) solution.others.push_back(found[k]);
    estimate(solution, terms, profile, scan, minima, options, correlated);
    return solution;
  }
}

}  // namespace gonio::fitting
