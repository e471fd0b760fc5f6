// SPDX-License-Identifier: BSD-3-Clause
// Linear interpolation between visits and what it is uncertain by.
#include "acquisition/visits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio::acquisition {

Visits::Visits(std::vector<Visit> visits) : visits_(std::move(visits)) {
  std::stable_sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) { return a.time_s < b.time_s; });
}

Visits::Place Visits::place(double time_s) const {
  const auto after = std::upper_bound(visits_.begin(), visits_.end(), time_s, [](double t, const Visit& v) { return t < v.time_s; });
  if (after == visits_.begin()) return {0, 0, 0};
  const auto a = static_cast<std::size_t>(after - visits_.begin());
  if (after == visits_.end()) return {a - 1, a - 1, 0};
  return {a - 1, a, (time_s - visits_[a - 1].time_s) / (visits_[a].time_s - visits_[a - 1].time_s)};
}

double Visits::at(double time_s) const {
  const auto [before, after, share] = place(time_s);
  return visits_[before].value + share * (visits_[after].value - visits_[before].value);
}

double Visits::common_variance() const {
  double sum = 0;
  for (const Visit& visit : visits_) sum += visit.variance;
  const auto n = static_cast<double>(visits_.size());
  return sum / (n * n);
}

double Visits::local_variance(double time_s) const {
  const auto [before, after, share] = place(time_s);
  const double own = before == after ? visits_[before].variance
                                     : (1 - share) * (1 - share) * visits_[before].variance + share * share * visits_[after].variance;
  const double local = own - common_variance();
  return std::isnan(local) ? local : std::max(0.0, local);
}

double Visits::straightness() const {
  const std::size_t n = visits_.size();
  if (n < 2) return std::numeric_limits<double>::quiet_NaN();
  if (n == 2) {
    const double change = visits_[1].value - visits_[0].value;
    return std::sqrt(std::max(0.0, change * change - visits_[0].variance - visits_[1].variance) / 12);
  }
  double excess = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Visit &a = visits_[k - 1], &b = visits_[k], &c = visits_[k + 1];
    const double share = (b.time_s - a.time_s) / (c.time_s - a.time_s);
    const double off = b.value - (a.value + share * (c.value - a.value));
    excess += off * off - (b.variance + (1 - share) * (1 - share) * a.variance + share * share * c.variance);
  }
  return std::sqrt(std::max(0.0, excess / static_cast<double>(n - 2))) / 4;
}

}  // namespace gonio::acquisition
