// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/multiple_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gonio::fitting {
namespace {

std::vector<std::size_t> ascending(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  return order;
}

}  // namespace

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<double> adjusted(p.size());
  double largest = 0;
  const auto order = ascending(p);
  for (std::size_t k = 0; k < order.size(); ++k) {
    largest = std::max(largest, std::min(1.0, p[order[k]] * static_cast<double>(order.size() - k)));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

std::vector<double> benjamini_hochberg(const std::vector<double>& p) {
  std::vector<double> adjusted(p.size());
  double least = 1;
  const auto order = ascending(p);
  for (std::size_t k = order.size(); k-- > 0;) {
    least = std::min(least, p[order[k]] * static_cast<double>(order.size()) / static_cast<double>(k + 1));
    adjusted[order[k]] = least;
  }
  return adjusted;
}

Located locate(std::vector<Place> places, const std::vector<double>& p, double alpha, std::size_t most) {
  Located out;
  const auto family_wise = holm(p), false_discovery = benjamini_hochberg(p);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!(false_discovery[k] < alpha)) continue;
    ++out.rejected_bh;
    out.rejected_holm += family_wise[k] < alpha;
    places[k].p_holm = family_wise[k];
    places[k].p_bh = false_discovery[k];
    out.places.push_back(std::move(places[k]));
  }
  std::stable_sort(out.places.begin(), out.places.end(), [](const Place& a, const Place& b) {
    return *a.p_holm != *b.p_holm ? *a.p_holm < *b.p_holm : std::abs(a.z.value_or(0)) > std::abs(b.z.value_or(0));
  });
  out.places.resize(std::min(out.places.size(), most));
  return out;
}

}  // namespace gonio::fitting
