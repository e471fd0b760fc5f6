// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/sums_search.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::fitting {
namespace {

constexpr double fine = 1e-9, coarse = 1e-4;  // on the axis, for minima on all rows and on few
constexpr double step = 0.01;                 // on the axis, for the curvature of the cost
constexpr double sigmas = 12;                 // half width of the stretch in standard deviations of the search on few rows
constexpr double least_reach = 2e-3, most_reach = 0.4;
constexpr double enough = 25;  // rise of the cost at the ends, in variances of one reading: five standard deviations
constexpr std::size_t stretch_points = 9;
constexpr int most_moves = 3;

/// The same sums without rows, on a part of them or on all.
Terms bare(const Terms& terms, std::shared_ptr<RowSums> sums) {
  Terms out;
  out.kernel = terms.kernel;
  out.transform = terms.transform;
  out.channel.resize(terms.channel.size());
  out.sums = std::move(sums);
  return out;
}

}  // namespace

Found search_on_sums(const Profile& profile, const SearchSpace& space, int threads) {
  const Terms& terms = profile.terms();
  const auto on_all_rows = [&] { return search_axis(profile, space, threads, fine); };
  const Terms some = bare(terms, terms.sums->few());
  const Profile quick(some, profile.limits());
  Found found = search_axis(quick, space, threads, coarse);
  const SearchAxis& axis = space.axes().front();
  const auto cost_at = [&](const Profile& of, double z) { return of.at(space.theta(std::span(&z, 1)), threads).cost; };

  double centre = found.minima.front().z.front();
  const double least = found.minima.front().point.cost,
               curvature = (cost_at(quick, centre - step) + cost_at(quick, centre + step) - 2 * least) / (step * step);
  const auto few_rows = static_cast<double>(some.sums->rows() * terms.channel.size());
  const double sigma = curvature > 0 ? std::sqrt(2 * least / few_rows / curvature) : most_reach;
  const double reach = std::clamp(sigmas * sigma, least_reach, most_reach);
  for (int move = 0; move < most_moves; ++move) {
    const double low = std::max(axis.low, centre - reach), high = std::min(axis.high, centre + reach);
    terms.sums->prepare(axis.value(low), axis.value(high), threads);
    std::vector<ProfilePoint> stretch;
    for (std::size_t k = 0; k < stretch_points; ++k) {
      const double z = low + (high - low) * static_cast<double>(k) / (stretch_points - 1);
      stretch.push_back(profile.at(space.theta(std::span(&z, 1)), threads));
    }
    Minimum minimum = lowest_between(profile, space, low, high, threads);
    const double room = 0.1 * reach;
    const bool at_end = (minimum.z.front() < low + room && low > axis.low) || (minimum.z.front() > high - room && high < axis.high);
    if (at_end) {
      centre = minimum.z.front();
      continue;
    }
    const double variance = minimum.point.cost / static_cast<double>(terms.sums->rows() * terms.channel.size());
    const auto rises = [&](const ProfilePoint& end) { return end.cost > minimum.point.cost + enough * variance; };
    if (!(rises(stretch.front()) || low <= axis.low) || !(rises(stretch.back()) || high >= axis.high)) return on_all_rows();
    for (std::size_t k = 1; k < found.minima.size(); ++k) found.minima[k].point = profile.at(found.minima[k].point.theta, threads);
    found.minima.front() = std::move(minimum);
    std::stable_sort(found.minima.begin(), found.minima.end(),
                     [](const Minimum& a, const Minimum& b) { return a.point.cost < b.point.cost; });
    found.scan = std::move(stretch);
    return found;
  }
  return on_all_rows();
}

}  // namespace gonio::fitting
