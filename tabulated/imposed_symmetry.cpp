// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/imposed_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gonio::tabulated {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Direction turned(const Direction& d, const Angle& by) {
  return Direction::trusted(by.cos() * d.x() - by.sin() * d.y(), by.sin() * d.x() + by.cos() * d.y(), d.z());
}

Direction mirrored(const Direction& d) { return Direction::trusted(d.x(), -d.y(), d.z()); }

}  // namespace

ImposedBrdf::ImposedBrdf(std::shared_ptr<const Brdf> brdf, std::shared_ptr<const UncertainBrdf> uncertain, Symmetry imposed)
    : brdf_(std::move(brdf)), uncertain_(std::move(uncertain)), imposed_(imposed) {}

Symmetry ImposedBrdf::symmetry() const {
  const Symmetry own = brdf_->symmetry();
  return {own.isotropic || imposed_.isotropic, own.bilateral || imposed_.bilateral, own.reciprocal || imposed_.reciprocal};
}

void ImposedBrdf::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  std::vector<double> u(f.size());
  std::vector<Coverage> coverage(wi.size());
  eval_with_uncertainty(wi, wo, f, u, coverage);
}

void ImposedBrdf::eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f,
                                        std::span<double> u, std::span<Coverage> coverage) const {
  const Symmetry own = brdf_->symmetry();
  const std::size_t channels = brdf_->channels().size();
  // The pairs and their partners, those of pair k from first[k] on.
  std::vector<Direction> in, out;
  std::vector<std::size_t> first;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    const std::size_t begin = in.size();
    first.push_back(begin);
    in.push_back(wi[k]), out.push_back(wo[k]);
    if (imposed_.reciprocal && !own.reciprocal && wo[k].z() > 0) in.push_back(wo[k]), out.push_back(wi[k]);
    if (imposed_.bilateral && !own.bilateral)
      for (std::size_t p = begin, end = in.size(); p < end; ++p) in.push_back(mirrored(in[p])), out.push_back(mirrored(out[p]));
    if (imposed_.isotropic && !own.isotropic)
      for (std::size_t p = begin, end = in.size(); p < end; ++p)
        for (int turn = 1; turn < turns; ++turn) {
          const Angle by = degrees(360.0 * turn / turns);
          in.push_back(turned(in[p], by)), out.push_back(turned(out[p], by));
        }
  }
  first.push_back(in.size());
  std::vector<double> all_values(in.size() * channels, nan), all_uncertainties(in.size() * channels, nan);
  std::vector<Coverage> all_how(in.size(), Coverage::interpolated);
  if (uncertain_)
    uncertain_->eval_with_uncertainty(in, out, all_values, all_uncertainties, all_how);
  else
    brdf_->eval(in, out, all_values);
  for (std::size_t k = 0; k < wi.size(); ++k) {
    const std::size_t n = first[k + 1] - first[k];
    const auto values = std::span(all_values).subspan(first[k] * channels, n * channels);
    const auto uncertainties = std::span(all_uncertainties).subspan(first[k] * channels, n * channels);
    const auto how = std::span(all_how).subspan(first[k], n);
    coverage[k] = Coverage::unknown;
    for (std::size_t c = 0; c < channels; ++c) {
      // Below the horizon coverage is unknown and f is 0: every partner is there, and all of them count.
      Coverage best = Coverage::unknown;
      for (std::size_t p = 0; p < n; ++p)
        if (!std::isnan(values[p * channels + c])) best = std::min(best, how[p]);
      const auto counts = [&](std::size_t p) { return how[p] == best && !std::isnan(values[p * channels + c]); };
      bool known = true;
      std::size_t count = 0;
      for (std::size_t p = 0; p < n; ++p)
        if (counts(p)) ++count, known = known && uncertainties[p * channels + c] > 0;
      double weights = 0, sum = 0, shared = 0, scatter = 0;
      const auto weight = [&](std::size_t p) {
        return known ? 1 / (uncertainties[p * channels + c] * uncertainties[p * channels + c]) : 1.0;
      };
      for (std::size_t p = 0; p < n; ++p)
        if (counts(p)) {
          const double w = weight(p);
          weights += w, sum += w * values[p * channels + c], shared += w * uncertainties[p * channels + c];
        }
      const std::size_t at = k * channels + c;
      f[at] = count > 0 ? sum / weights : nan;
      for (std::size_t p = 0; p < n; ++p)
        if (counts(p)) scatter += weight(p) * (values[p * channels + c] - f[at]) * (values[p * channels + c] - f[at]);
      u[at] = count == 0 || !known ? nan : shared / weights;
      if (count > 1 && known) u[at] = std::max(u[at], std::sqrt(scatter / weights / static_cast<double>(count - 1)));
      coverage[k] = std::min(coverage[k], best);
    }
  }
}

SymmetryChange symmetry_change(std::span<const GonioAngles> pairs, std::span<const double> before, const Brdf& after) {
  const std::size_t channels = after.channels().size();
  std::vector<Direction> wi, wo;
  for (const GonioAngles& pair : pairs) wi.push_back(pair.wi()), wo.push_back(pair.wo());
  std::vector<double> f(pairs.size() * channels);
  after.eval(wi, wo, f);
  SymmetryChange out;
  std::vector<double> changes;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (!(before[k] > 0) || !(f[k] > 0)) {
      ++out.n_left_out;
      continue;
    }
    const double change = std::fabs(std::log(f[k] / before[k]));
    constexpr double rounding = 1e-12;
    out.n_changed += change > rounding ? 1 : 0;
    if (change > out.largest) out.largest = change, out.largest_at = pairs[k / channels];
    changes.push_back(change);
    out.mean += change;
  }
  out.n = changes.size();
  if (changes.empty()) return out;
  out.mean /= static_cast<double>(changes.size());
  const auto at = changes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(changes.size()));
  std::nth_element(changes.begin(), at, changes.end());
  out.p95 = *at;
  return out;
}

}  // namespace gonio::tabulated
