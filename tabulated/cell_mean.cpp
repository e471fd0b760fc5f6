// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/cell_mean.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tabulated/node_values.hpp"

namespace gonio::tabulated {
namespace {

constexpr double nothing_per_sr = 1e-6;
/// Of the uncertainty of a mean that two rules may differ by: the finer one has at least three times the points in four dimensions, so even
/// of a rough function it is about twice as close, and its error adds 3 % to the uncertainty.
constexpr double part_of_u = 0.5;

}  // namespace

CellMean::CellMean(const Opened& source, const ChannelMap& map, std::vector<std::size_t> orders, double tolerance)
    : source_(source), map_(map), tolerance_(tolerance) {
  for (const std::size_t order : orders) rules_.emplace_back(order);
}

CellMean::Result CellMean::with_rule(const GaussLegendre& rule, std::size_t dimensions,
                                     const std::function<DirectionPair(std::span<const double>)>& pair, ExportNotes& notes) const {
  const std::size_t order = rule.nodes.size();
  std::size_t count = 1;
  for (std::size_t i = 0; i < dimensions; ++i) count *= order;
  std::vector<Direction> wi(count), wo(count);
  std::vector<double> weights(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<double, max_dimensions> at{};
    weights[k] = 1;
    for (std::size_t i = 0, rest = k; i < dimensions; ++i, rest /= order)
      at[i] = rule.nodes[rest % order], weights[k] *= rule.weights[rest % order];
    const DirectionPair directions = pair({at.data(), dimensions});
    wi[k] = directions.wi, wo[k] = directions.wo;
  }
  const NodeValues values = node_values(source_, wi, wo, 1, notes);
  Result out;
  const std::size_t channels = map_.to.size();
  std::array<double, max_channels> f{};
  double total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    map_.apply(values.f.data() + k * values.channel_count, f.data());
    if (std::any_of(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(channels), [](double value) { return std::isnan(value); })) continue;
    total += weights[k];
    for (std::size_t c = 0; c < channels; ++c) out.f[c] += weights[k] * f[c];
    if (values.u.empty()) continue;
    map_.apply(values.u.data() + k * values.channel_count, f.data());
    for (std::size_t c = 0; c < channels; ++c)
      if (f[c] > 0) out.u[c] += weights[k] * f[c];
  }
  out.known = total > 0;
  if (out.known)
    for (std::size_t c = 0; c < channels; ++c) out.f[c] /= total, out.u[c] /= total;
  return out;
}

CellMean::Result CellMean::operator()(std::size_t dimensions, const std::function<DirectionPair(std::span<const double>)>& pair,
                                      std::size_t first_order, ExportNotes& notes) const {
  std::optional<Result> last;
  for (const GaussLegendre& rule : rules_) {
    if (rule.nodes.size() < first_order) continue;
    Result mean = with_rule(rule, dimensions, pair, notes);
    if (last) {
      for (std::size_t c = 0; c < map_.to.size(); ++c) {
        const double difference = std::fabs(mean.f[c] - last->f[c]), size = std::fabs(mean.f[c]);
        if (difference > tolerance_ * size + part_of_u * mean.u[c] + nothing_per_sr)
          mean.unsettled = std::max(mean.unsettled, difference / size);
      }
      if (mean.unsettled == 0) return mean;
    }
    last = mean;
  }
  return *last;
}

void add_counts(const ExportNotes& part, ExportNotes& notes) {
  notes.n_nodes += part.n_nodes;
  notes.n_below_horizon += part.n_below_horizon;
  notes.n_unknown += part.n_unknown;
  notes.n_negative += part.n_negative;
  notes.n_extrapolated += part.n_extrapolated;
}

}  // namespace gonio::tabulated
