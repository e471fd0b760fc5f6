// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/stretch_search.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "fitting/global_search.hpp"
#include "fitting/linearisation.hpp"

namespace gonio::fitting {
namespace {

constexpr double beyond = 7, wander = 5;                // standard deviations: of the parameter, and of the place found on some rows
constexpr double least_reach = 2e-3, most_reach = 0.4;  // on the axis
constexpr double enough = 25;                           // rise of the cost at the ends, in variances of one reading
constexpr double room = 0.1;                            // of the reach: a minimum nearer to an end may lie beyond it
constexpr double borne = 1e-4;                          // error of the cost in variances of one reading; an interval ends four up
constexpr std::size_t points = 9;
constexpr int most_moves = 3;

/// The standard uncertainty on the axis, from the rows linearised about a point.
double standard_uncertainty(const Profile& profile, const SearchSpace& space, const ProfilePoint& at, double values, int threads) {
  const Linearisation about = linearise(profile.terms(), space, profile.limits(), at.linear(), at.theta, {}, threads);
  double cost = 0;
  for (std::size_t c = 0; c < about.r.size(); ++c) {
    const auto residual = about.r[c].column(about.r[c].columns() - 1);
    for (const double part : residual) cost += part * part;
  }
  std::vector<double> normal, gradient;
  about.reduced(normal, gradient);
  const SearchAxis& axis = space.axes().front();
  return std::sqrt(cost / values / normal.front()) / axis.slope(at.theta[axis.parameter]);
}

}  // namespace

std::optional<StretchFound> search_on_stretch(Profile& profile, const SearchSpace& space, const Minimum& about, std::size_t looked_at,
                                              int threads) {
  const Terms& terms = profile.terms();
  const SearchAxis& axis = space.axes().front();
  const auto rows = static_cast<double>(terms.sums ? terms.sums->rows() : terms.rows());
  const double values = rows * static_cast<double>(terms.channel.size());
  const double sigma = standard_uncertainty(profile, space, about.point, values, threads);
  const double part = std::sqrt(rows / static_cast<double>(looked_at));
  const double wanted = (beyond + wander * part) * sigma,
               reach = std::isfinite(wanted) ? std::clamp(wanted, least_reach, most_reach) : most_reach;
  double centre = about.z.front();
  for (int move = 0; move < most_moves; ++move) {
    const double low = std::max(axis.low, centre - reach), high = std::min(axis.high, centre + reach);
    profile.prepare(space, low, high, threads);
    StretchFound found{low, high, {}, {}, 0};
    found.lowest = lowest_between(profile, space, low, high, threads);
    centre = found.lowest.z.front();
    const double margin = room * reach;
    if ((centre < low + margin && low > axis.low) || (centre > high - margin && high < axis.high)) continue;
    const double variance = found.lowest.point.cost / values;
    if (!terms.sums) {
      const double interpolated = found.lowest.point.cost;
      found.lowest.point = profile.at_rows(found.lowest.point.theta, threads);
      if (!(std::abs(interpolated - found.lowest.point.cost) <= borne * variance)) break;
    }
    found.well_above = found.lowest.point.cost + enough * variance;
    for (std::size_t k = 0; k < points; ++k) {
      const double z = low + (high - low) * static_cast<double>(k) / (points - 1);
      found.scan.push_back(profile.at(space.theta(std::span(&z, 1)), threads));
    }
    const bool ends_left = found.scan.front().cost > found.well_above || low <= axis.low;
    const bool ends_right = found.scan.back().cost > found.well_above || high >= axis.high;
    if (ends_left && ends_right) return found;
    break;
  }
  profile.forget();
  return std::nullopt;
}

}  // namespace gonio::fitting
