// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/solution.hpp"

#include <cmath>
#include <utility>

#include "fitting/polish.hpp"

namespace gonio::fitting {
namespace {

constexpr int reweighting_rounds = 3;  // the weights have settled to 1e-6 by then (numerics C13)

/// Every minimum under the asked metric, in the order of the search; where the solver fails the best of them says so in `solution`.
std::vector<OtherSolution> polished(const Terms& terms, const SearchSpace& space, const Found& found, const SolveOptions& options,
                                    Solution& solution) {
  std::vector<OtherSolution> out;
  for (const Minimum& minimum : found.minima) {
    OtherSolution next{minimum.point.linear(), minimum.point.theta, minimum.point.cost};
    if (!terms.transform.linear()) {
      const Polished polished = polish(terms, space, options.limits, next.linear, next.theta, options.threads);
      if (polished.converged && polished.cost <= next.cost) next = {polished.linear, polished.theta, polished.cost};
      if (!polished.converged && out.empty()) {
        solution.converged = false;
        solution.reason = "the solver stopped before it converged: " + polished.reason;
      }
    }
    space.order(next.theta, next.linear);
    out.push_back(std::move(next));
  }
  return out;
}

}  // namespace

Matrix Solution::covariance_of(std::size_t channel) const {
  const std::size_t own = linear[channel].size(), all = own * linear.size();
  const auto place = [&](std::size_t k) { return k < own ? channel * own + k : all + k - own; };
  Matrix out(own + theta.size(), own + theta.size());
  for (std::size_t a = 0; a < out.rows(); ++a)
    for (std::size_t b = 0; b < out.rows(); ++b) out(a, b) = covariance(place(a), place(b));
  return out;
}

Solution solve(Terms& terms, const SolveOptions& options, const std::vector<Change>& changes, std::vector<Minimum> known) {
  const SearchSpace space(terms.kernel, options.nonlinear, options.alike);
  Solution solution;
  Laps lap;
  Found found;
  for (int round = 0;; ++round) {
    Profile profile(terms, options.limits);
    found = search_globally(profile, space, options.threads, std::move(known));
    if (found.minima.empty() || !std::isfinite(found.minima.front().point.cost)) {
      solution.reason = "the cost is not finite anywhere on the scan";
      return solution;
    }
    const ProfilePoint& lowest = found.minima.front().point;
    if (round < reweighting_rounds && reweight(terms, lowest.linear(), lowest.theta)) {
      known = std::move(found.minima);
      continue;
    }

    solution.converged = true;
    std::vector<OtherSolution> all = polished(terms, space, found, options, solution);
    std::size_t best = 0;
    for (std::size_t k = 1; k < all.size(); ++k)
      if (all[k].cost < all[best].cost) best = k;
    solution.linear = all[best].linear;
    solution.theta = all[best].theta;
    solution.cost = all[best].cost;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k != best) solution.others.push_back(std::move(all[k]));
    solution.scan_s = lap();
    if (!options.only_values) estimate(solution, profile, space, found, options, changes);
    solution.intervals_s = lap();
    return solution;
  }
}

}  // namespace gonio::fitting
