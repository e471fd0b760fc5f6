// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/repeatability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fitting/checks/sample_places.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t enough_repeats = 3;
constexpr std::size_t blocks = 20;  // each with enough places for a median of its own
constexpr std::size_t enough_places = 40;

struct Size {
  double square = 0, count = 0, ratio = 0;
  std::size_t reading = 0;
};

/// Relative size of every place and channel, in the order of the data.
std::vector<std::pair<double, Size>> sizes_of(const Contrasts& set) {
  std::map<std::pair<std::size_t, std::size_t>, Size> sizes;
  for (const Contrast& contrast : set.contrasts) {
    if (!(contrast.mean > 0)) continue;  // no relative size
    Size& size = sizes[{contrast.place, set.readings[contrast.terms[0].reading].channel}];
    double c = 0;
    for (const auto& [reading, weight] : contrast.terms) c += weight * set.readings[reading].f;
    const double first = set.readings[contrast.terms[0].reading].f;
    if (size.count == 0) size.reading = contrast.terms[0].reading;
    if (first - c > 0 && first > 0) size.ratio = first / (first - c);
    size.square += c * c / (contrast.scale * contrast.scale);
    size.count += 1;
  }
  std::vector<std::pair<double, Size>> out;
  for (const auto& [key, size] : sizes) out.emplace_back(std::sqrt(size.square / size.count), size);
  return out;
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<Repeatability> repeated_readings(const std::vector<std::shared_ptr<const Dataset>>& datasets) {
  std::vector<double> scatter;
  for (const auto& dataset : datasets) {
    Places index;
    std::vector<std::vector<std::size_t>> samples;
    for (std::size_t k = 0; k < dataset->size(); ++k) {
      const std::size_t place = index.add(key_of(dataset->angles[k]));
      if (place == samples.size()) samples.emplace_back();
      samples[place].push_back(k);
    }
    for (const auto& place : samples)
      for (const auto& f : dataset->f) {
        double n = 0, mean = 0, square = 0;
        for (const std::size_t k : place)
          if (std::isfinite(f[k])) n += 1, mean += f[k];
        mean /= n;
        for (const std::size_t k : place)
          if (std::isfinite(f[k])) square += (f[k] - mean) * (f[k] - mean);
        if (n >= static_cast<double>(enough_repeats) && mean > 0) scatter.push_back(std::sqrt(square / (n - 1)) / mean);
      }
  }
  if (scatter.empty()) return std::nullopt;
  return Repeatability{median_of(scatter), scatter.size(), "readings repeated at the same place"};
}

MedianEffect median_effect(const Contrasts& set, double alpha) {
  MedianEffect out;
  std::vector<double> sizes;
  for (const auto& [size, place] : sizes_of(set)) sizes.push_back(size);
  out.n = sizes.size();
  out.median = median_of(sizes);
  double square = 0, scale = 0;
  for (const Contrast& contrast : set.contrasts) {
    double c = 0;
    for (const auto& [reading, weight] : contrast.terms) c += weight * set.readings[reading].f;
    square += c * c, scale += contrast.scale * contrast.scale;
  }
  out.rms = scale > 0 ? std::sqrt(square / scale) : 0;
  out.lower = 0, out.upper = INFINITY;
  if (out.n < enough_places) return out;
  double mean = 0, scatter = 0;
  std::vector<double> medians;
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto at = [&](std::size_t k) { return sizes.begin() + static_cast<std::ptrdiff_t>(k * sizes.size() / blocks); };
    medians.push_back(median_of({at(b), at(b + 1)}));
    mean += medians.back() / blocks;
  }
  for (const double median : medians) scatter += (median - mean) * (median - mean) / (blocks - 1);
  out.u = std::sqrt(scatter / blocks);
  const double reach = student_two_sided_quantile(1 - 2 * alpha, blocks - 1) * out.u;
  out.lower = std::max(0.0, out.median - reach), out.upper = out.median + reach;
  return out;
}

void judge_without_uncertainty(Check& check, const Contrasts& set, const std::optional<Repeatability>& repeatability,
                               const CheckSubject& subject, const CheckOptions& options, const std::string& tested) {
  const MedianEffect effect = median_effect(set, options.alpha);
  check.n = effect.n;
  check.effect = effect.median;
  check.effect_upper = effect.upper;
  if (effect.u > 0) check.u_effect = effect.u;
  const double noise2 = repeatability ? repeatability->relative * repeatability->relative : 0;
  const double beyond2 = effect.lower * effect.lower - noise2;
  check.verdict = effect.upper <= options.margin && effect.rms <= options.margin              ? Verdict::pass
                  : repeatability && beyond2 > options.margin * options.margin && beyond2 > 0 ? Verdict::fail
                                                                                              : Verdict::vacuous;
  check.detail = fmt::format("{}: median {} ± {}, rms {}, noise included, because the data state no uncertainty", tested,
                             percent_text(effect.median), percent_text(effect.u), percent_text(effect.rms));
  if (repeatability)
    check.detail +=
        fmt::format("; {} differ by {} (median of {})", repeatability->source, percent_text(repeatability->relative), repeatability->n);
  if (check.verdict == Verdict::vacuous) {
    if (effect.n < enough_places)
      check.detail += "; too few places for limits";
    else if (!repeatability)
      check.detail += "; nothing is repeated, so noise cannot be told from a violation";
    else
      check.detail += fmt::format("; that cannot be told from a violation of {}", percent_text(options.margin));
  }
  if (check.verdict == Verdict::pass) return;
  auto sizes = sizes_of(set);
  std::stable_sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < std::min(options.where, sizes.size()); ++k) {
    const Reading& reading = set.readings[sizes[k].second.reading];
    Place place;
    place.angles = reading.angles;
    place.channel = subject.datasets[0]->channels[reading.channel].name;
    if (sizes[k].second.ratio > 0) place.ratio = sizes[k].second.ratio;
    check.where.push_back(std::move(place));
  }
}

}  // namespace gonio::fitting
