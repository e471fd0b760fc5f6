// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/paired_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gonio::fitting {
namespace {

struct PlacedSamples {
  GonioAngles angles;
  std::vector<std::size_t> samples;
};

void add_pairs_of(const Dataset& dataset, const PlaceSymmetry& symmetry, const Patterns& patterns, std::size_t first,
                  std::size_t components, std::size_t& next_place, Contrasts& out) {
  const std::vector<double> time = parts_of_time(dataset);
  Places index;
  std::vector<PlacedSamples> places;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const std::size_t place = index.add(symmetry.key(dataset.angles[k]));
    if (place == places.size()) places.push_back({dataset.angles[k], {}});
    places[place].samples.push_back(k);
  }
  for (std::size_t a = 0; a < places.size(); ++a) {
    const auto b = index.find(symmetry.key(symmetry.image(places[a].angles)));
    if (!b || *b <= a) continue;
    const std::size_t one_sample = places[a].samples.front(), other_sample = places[*b].samples.front();
    const auto here = patterns(dataset.angles[one_sample], time[one_sample]);
    const auto there = patterns(dataset.angles[other_sample], time[other_sample]);
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      auto one = reading_of(dataset, c, places[a].samples, first, components);
      auto other = reading_of(dataset, c, places[*b].samples, first, components);
      if (!one || !other) continue;
      Contrast contrast;
      contrast.mean = 0.5 * (one->f + other->f);
      contrast.scale = std::abs(contrast.mean);
      for (std::size_t k = 0; k < here.size(); ++k) contrast.pattern.push_back(contrast.mean * (here[k] - there[k]));
      contrast.place = next_place;
      contrast.terms = {{out.readings.size(), 1}, {out.readings.size() + 1, -1}};
      out.readings.push_back(std::move(*one));
      out.readings.push_back(std::move(*other));
      out.contrasts.push_back(std::move(contrast));
    }
    ++next_place;
  }
}

}  // namespace

std::vector<std::size_t> first_components(const std::vector<std::shared_ptr<const Dataset>>& datasets) {
  std::vector<std::size_t> first{0};
  for (const auto& dataset : datasets) first.push_back(first.back() + dataset->correlated.size());
  return first;
}

std::optional<Reading> reading_of(const Dataset& dataset, std::size_t channel, const std::vector<std::size_t>& samples, std::size_t first,
                                  std::size_t components) {
  const auto mean = mean_of(dataset, channel, samples);
  if (!mean) return std::nullopt;
  Reading reading{mean->f, mean->u, std::vector<double>(components, 0.0), dataset.angles[samples.front()], channel};
  std::copy(mean->shared.begin(), mean->shared.end(), reading.shared.begin() + static_cast<std::ptrdiff_t>(first));
  return reading;
}

void add_pairs(const std::vector<std::shared_ptr<const Dataset>>& datasets, const PlaceSymmetry& symmetry, const Patterns& patterns,
               Contrasts& out) {
  const auto first = first_components(datasets);
  std::size_t next_place = 0;
  for (std::size_t d = 0; d < datasets.size(); ++d) add_pairs_of(*datasets[d], symmetry, patterns, first[d], first.back(), next_place, out);
}

GonioAngles mirrored(const GonioAngles& angles) noexcept {
  return {angles.theta_i, angles.phi_i, angles.theta_o, angles.phi_i + (angles.phi_i - angles.phi_o)};
}

Contrasts mirror_pairs(const std::vector<std::shared_ptr<const Dataset>>& datasets) {
  Contrasts pairs;
  pairs.pattern_names = {"the side of the plane of incidence", "time"};
  pairs.pattern_share = {0.5, 0.1};
  add_pairs(
      datasets, {key_of, mirrored},
      [](const GonioAngles& angles, double time) {
        return std::vector<double>{angles.theta_o.sin() * (angles.phi_o - angles.phi_i).sin(), time};
      },
      pairs);
  return pairs;
}

std::vector<double> parts_of_time(const Dataset& dataset) {
  std::vector<double> parts(dataset.size(), 0.0);
  const auto time = dataset.extra.find("time_s");
  if (time == dataset.extra.end() || time->second.empty()) return parts;
  const auto [begin, end] = std::minmax_element(time->second.begin(), time->second.end());
  if (*end > *begin)
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] = (time->second[k] - *begin) / (*end - *begin);
  return parts;
}

}  // namespace gonio::fitting
