// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/weigh_and_convolve.hpp"

#include <algorithm>
#include <utility>

#include "fitting/point_fit.hpp"

namespace gonio::fitting {
namespace {

constexpr int most_rounds = 4;

/// 1/σ² of the transformed readings, [channel][row], of those left out as wrong too; 0 where there is no reading.
std::vector<std::vector<double>> inverse_variance(const Terms& terms, const std::vector<ChannelTerms>& before, const Weighting& weighting,
                                                  const ProfilePoint& at, std::size_t free) {
  double values = 0;
  for (const ChannelTerms& channel : terms.channel) values += static_cast<double>(channel.count);
  const double variance = at.cost / std::max(1.0, values - static_cast<double>(free));  // of a reading with weight 1
  const auto fitted = fitted_values(terms, at.linear(), at.theta);
  std::vector<std::vector<double>> out;
  for (std::size_t c = 0; c < before.size(); ++c) {
    std::vector<double> weight = before[c].weight;
    for (std::size_t row = 0; row < weight.size(); ++row) {
      if (!(weight[row] > 0) || terms.weighted) continue;
      if (weighting.variance.empty()) {
        weight[row] /= variance;
        continue;
      }
      const double cos_i = terms.geometry[row].cos_i, slope = terms.transform.linear() ? 1 : terms.transform.slope(fitted[c][row], cos_i);
      weight[row] = 1 / (weighting.variance[c](fitted[c][row], tan_squared(cos_i)) * slope * slope);
    }
    out.push_back(std::move(weight));
  }
  return out;
}

}  // namespace

Weighed weigh_and_convolve(Terms& terms, const SolveOptions& how, const WeigherOptions& weigher, const Observations* observations,
                           const FitOptions& options, ApertureEffect& effect) {
  bool open = false;
  for (std::size_t b = 0; observations && b < observations->block_count() && !open; ++b) {
    const Apertures stated = observations->apertures(b);
    open = stated.source_half_angle_deg.value_or(0) > 0 || stated.receiver_half_angle_deg.value_or(0) > 0;
  }
  const bool look = open && !options.ignore_apertures && !terms.collapsed;
  if (!look)
    effect.reason = open ? (terms.collapsed ? "left out: rows of a table are points" : "left out as asked") : "the data state no apertures";
  const std::vector<ChannelTerms> before = look ? terms.channel : std::vector<ChannelTerms>{};
  for (int round = 0;; ++round) {
    PointFit point_fit(terms, how);
    Weighting out = weigh(terms, weigher, [&](bool global) { return point_fit(global); });
    if (!look || round == most_rounds || !point_fit(!point_fit.last())) return {std::move(out), point_fit.minima()};
    const ProfilePoint& at = point_fit.last()->point;
    const std::size_t rows = terms.mean.row.size(), nodes = terms.mean.geometry.size();
    ApertureEffect now = convolve(terms, *observations, at.linear(), at.theta,
                                  inverse_variance(terms, before, out, at, weigher.free_parameters), options.threads);
    const bool settled = terms.mean.row.size() == rows && terms.mean.geometry.size() == nodes;
    if (effect.reason.empty() || now.on) effect = std::move(now);
    if (settled) return {std::move(out), point_fit.minima()};
    terms.channel = before;
  }
}

bool weigh_by_part(LargeTable& large, const WeigherOptions& weigher, const SolveOptions& how, Weighting& weighting) {
  PointFit point_fit(large.part, how);
  weighting = weigh(large.part, weigher, [&](bool global) { return point_fit(global); });
  if (weighting.robust != Robust::none) {
    weighting = {};
    return false;
  }
  if (!weighting.variance.empty() && point_fit.last())
    large.weigh(weighting.variance, point_fit.last()->point.linear(), point_fit.last()->point.theta, how.threads);
  return true;
}

}  // namespace gonio::fitting
