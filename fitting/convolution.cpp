// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/convolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "fitting/terms.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double negligible = 0.1;  // standard uncertainties of a parameter
constexpr double left_over = 0.03;  // of the rows that stay points, and of the order of the rules: together well below that
constexpr int highest_order = 24;   // 2304 nodes on a disc
constexpr int highest_product = 5;  // 100 × 100 nodes where both apertures count
constexpr int smooth = 6;           // where rules settle by this order no lobe is narrow enough to hide from the nodes of order 1
constexpr std::size_t most_nodes = std::size_t{1} << 21;  // of all rows together: 0.25 GB
constexpr std::size_t rows_at_once = 64;

struct HalfAngles {
  double source = 0, receiver = 0;  ///< [rad]
};

HalfAngles half_angles(const Apertures& apertures) {
  const double to_radians = std::numbers::pi / 180;
  return {apertures.source_half_angle_deg.value_or(0) * to_radians, apertures.receiver_half_angle_deg.value_or(0) * to_radians};
}

/// The angles and half-angles of every row.
struct RowApertures {
  std::vector<GonioAngles> angles;
  std::vector<HalfAngles> half;

  RowApertures(const Terms& terms, const Observations& observations) {
    std::size_t row = 0, first = 0;
    std::vector<GonioAngles> block;
    for (std::size_t b = 0; b < observations.block_count(); ++b) {
      const std::size_t end = first + observations.block(b).size;
      observations.angles(b, block);
      const HalfAngles own = half_angles(observations.apertures(b));
      for (; row < terms.rows() && terms.sample[row] < end; ++row) angles.push_back(block[terms.sample[row] - first]), half.push_back(own);
      first = end;
    }
  }
};

/// Of one order on every aperture that is open.
ApertureRule rule_of(HalfAngles half, int order) {
  const bool both = half.source > 0 && half.receiver > 0;
  const int own = std::min(order, both ? highest_product : highest_order);
  return {half.source, half.receiver, half.source > 0 ? own : 0, half.receiver > 0 ? own : 0};
}

class Means {
 public:
  Means(const Terms& terms, const RowApertures& rows, const std::vector<std::vector<double>>& linear, const std::vector<double>& theta,
        const std::vector<std::vector<double>>& weight, int threads)
      : terms_(terms), rows_(rows), linear_(linear), theta_(theta), weight_(weight), threads_(threads) {}

  /// f̂ in every channel as means with rules of one order, [row of the list][channel]; order 0 gives the points.
  std::vector<std::vector<double>> values(const std::vector<std::size_t>& rows, int order) const {
    std::vector<std::vector<double>> out(rows.size());
    for_each_index((rows.size() + rows_at_once - 1) / rows_at_once, threads_, [&](std::size_t piece) {
      std::vector<LobeGeometry> geometry;
      std::vector<double> weight, columns;
      for (std::size_t j = piece * rows_at_once; j < std::min(rows.size(), (piece + 1) * rows_at_once); ++j) {
        geometry.clear(), weight.clear();
        aperture_nodes(rows_.angles[rows[j]], rule_of(rows_.half[rows[j]], order), geometry, weight);
        columns.resize(linear_.front().size() * geometry.size());
        terms_.kernel.basis(geometry, theta_.data(), columns.data(), geometry.size());
        for (const std::vector<double>& x : linear_) {
          double mean = 0;
          for (std::size_t n = 0; n < weight.size(); ++n) {
            double f = 0;
            for (std::size_t k = 0; k < x.size(); ++k) f += x[k] * columns[k * geometry.size() + n];
            mean += weight[n] * f;
          }
          out[j].push_back(mean);
        }
      }
    });
    return out;
  }

  /// Σ over the channels of the squared change, in standard deviations.
  double square(std::size_t row, const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
      const double slope = terms_.transform.linear() ? 1 : terms_.transform.slope(a[c], terms_.geometry[row].cos_i);
      const double change = slope * (a[c] - b[c]);
      const double z2 = weight_[c][row] * change * change;
      sum += std::isfinite(z2) ? z2 : 0;
    }
    return sum;
  }

  /// Of all rows together.
  std::size_t nodes(const std::vector<std::size_t>& rows, int order) const {
    const auto on_disc = [](int own) { return own > 0 ? static_cast<std::size_t>(4 * own * own) : 1; };
    std::size_t out = 0;
    for (const std::size_t row : rows) {
      const ApertureRule rule = rule_of(rows_.half[row], order);
      out += on_disc(rule.source_order) * on_disc(rule.receiver_order);
    }
    return out;
  }

 private:
  const Terms& terms_;
  const RowApertures& rows_;
  const std::vector<std::vector<double>>& linear_;
  const std::vector<double>& theta_;
  const std::vector<std::vector<double>>& weight_;
  int threads_;
};

/// An order of the rules for some rows, and the change of the last step to a finer one, of all rows, in standard deviations.
struct Settled {
  int order = 1;
  double change = 0;
  std::vector<std::vector<double>> value;  ///< f̂ at this order, [row of the list][channel]
};

/// The lowest order that changes less than `left_over` against the one before, or the highest that exists and can be kept.
Settled settle(const Means& means, const std::vector<std::size_t>& rows) {
  Settled out;
  out.value = means.values(rows, out.order);
  while (means.nodes(rows, out.order + 1) > means.nodes(rows, out.order)) {
    std::vector<std::vector<double>> next = means.values(rows, out.order + 1);
    double sum = 0;
    for (std::size_t j = 0; j < rows.size(); ++j) sum += means.square(rows[j], next[j], out.value[j]);
    out.change = std::sqrt(sum);
    if (means.nodes(rows, out.order + 1) > most_nodes) break;
    ++out.order;
    out.value = std::move(next);
    if (out.change <= left_over) break;
  }
  return out;
}

/// The rows whose change counts: the largest first until what is left falls below `left_over`.
std::vector<std::size_t> rows_that_count(const std::vector<double>& square) {
  std::vector<std::size_t> order(square.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return square[a] < square[b]; });
  double sum = 0;
  auto first = order.begin();
  while (first != order.end() && sum + square[*first] < left_over * left_over) sum += square[*first++];
  std::vector<std::size_t> out(first, order.end());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void MeanRows::append(std::size_t number, const ApertureRule& by, std::span<const LobeGeometry> nodes, std::span<const double> weights) {
  if (first.empty()) first.push_back(0);
  row.push_back(number);
  rule.push_back(by);
  geometry.insert(geometry.end(), nodes.begin(), nodes.end());
  weight.insert(weight.end(), weights.begin(), weights.end());
  first.push_back(geometry.size());
}

MeanRows MeanRows::renumbered(std::span<const std::size_t> sample) const {
  MeanRows out = *this;
  for (std::size_t& number : out.row) number = sample[number];
  return out;
}

MeanRows MeanRows::of(std::span<const std::size_t> rows) const {
  MeanRows out;
  for (std::size_t j = 0; j < rows.size() && !row.empty(); ++j) {
    const auto found = std::lower_bound(row.begin(), row.end(), rows[j]);
    if (found == row.end() || *found != rows[j]) continue;
    const auto k = static_cast<std::size_t>(found - row.begin());
    const std::size_t size = first[k + 1] - first[k];
    out.append(j, rule[k], std::span(geometry).subspan(first[k], size), std::span(weight).subspan(first[k], size));
  }
  return out;
}

ApertureEffect convolve(Terms& terms, const Observations& observations, const std::vector<std::vector<double>>& linear,
                        const std::vector<double>& theta, const std::vector<std::vector<double>>& weight, int threads) {
  ApertureEffect effect;
  if (terms.collapsed) return effect;
  const RowApertures apertures(terms, observations);
  const Means means(terms, apertures, linear, theta, weight, threads);
  std::vector<std::size_t> all;
  for (std::size_t row = 0; row < terms.rows(); ++row)
    if (apertures.half[row].source > 0 || apertures.half[row].receiver > 0) all.push_back(row);
  if (all.empty()) return effect;

  const auto points = means.values(all, 0);
  std::vector<std::size_t> rows;
  Settled rule;
  // A lobe much narrower than the aperture is missed by coarse rules in most rows: then every row is looked at with the finer one.
  for (int seen = 1;; seen = rule.order) {
    const auto means_seen = means.values(all, seen);
    std::vector<double> square(terms.rows(), 0.0);
    for (std::size_t j = 0; j < all.size(); ++j) square[all[j]] = means.square(all[j], means_seen[j], points[j]);
    effect.bound = std::sqrt(std::accumulate(square.begin(), square.end(), 0.0));
    effect.on = effect.bound >= negligible || !terms.mean.empty();
    if (!effect.on) {
      effect.reason =
          fmt::format("left out: means over the apertures would move no parameter by more than {:.2g} of its uncertainty", effect.bound);
      return effect;
    }
    std::vector<double> counted = square;
    for (const std::size_t row : terms.mean.row) counted[row] = std::max(counted[row], 1.0);
    rows = rows_that_count(counted);
    rule = settle(means, rows);
    if (rule.order > std::max(seen, smooth)) continue;
    const auto points_here = means.values(rows, 0);
    for (std::size_t j = 0; j < rows.size(); ++j) square[rows[j]] = means.square(rows[j], rule.value[j], points_here[j]);
    effect.bound = std::sqrt(std::accumulate(square.begin(), square.end(), 0.0));
    break;
  }
  terms.mean = {};
  std::vector<LobeGeometry> geometry;
  std::vector<double> part;
  for (const std::size_t row : rows) {
    geometry.clear(), part.clear();
    const ApertureRule own = rule_of(apertures.half[row], rule.order);
    aperture_nodes(apertures.angles[row], own, geometry, part);
    if (!geometry.empty()) terms.mean.append(row, own, geometry, part);
  }
  effect.n_samples = terms.mean.row.size();
  effect.reason = fmt::format(
      "means over the apertures, {} nodes for each of {} samples: left out they could move a parameter by {:.2g} of its uncertainty",
      terms.mean.empty() ? 0 : terms.mean.first[1], effect.n_samples, effect.bound);
  if (rule.change > left_over) effect.reason += fmt::format("; finer rules still could by {:.2g}", rule.change);
  return effect;
}

}  // namespace gonio::fitting
