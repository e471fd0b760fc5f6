// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/weighting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gonio::fitting {
namespace {

constexpr std::array<std::pair<Weights, const char*>, 5> weights_names{{{Weights::automatic, "auto"},
                                                                        {Weights::none, "none"},
                                                                        {Weights::uncertainty, "uncertainty"},
                                                                        {Weights::variance, "variance"},
                                                                        {Weights::solid_angle, "solid_angle"}}};

}  // namespace

const char* name(Weights weights) noexcept {
  for (const auto& [value, text] : weights_names)
    if (value == weights) return text;
  return "none";
}

std::optional<Weights> weights_named(std::string_view text) {
  for (const auto& [value, known] : weights_names)
    if (text == known) return value;
  return std::nullopt;
}

const char* name(WeightSource source) noexcept {
  switch (source) {
    case WeightSource::none: return "none";
    case WeightSource::solid_angle: return "solid_angle";
    case WeightSource::uncertainty: return "uncertainty";
    case WeightSource::repeats: return "repeats";
    case WeightSource::rows: return "rows";
    case WeightSource::residuals: return "residuals";
  }
  return "none";
}

void Weighting::add(std::vector<Outlier> more) {
  n_outliers += more.size();
  outliers.insert(outliers.end(), more.begin(), more.end());
  if (outliers.size() > most_listed) {
    const auto last = outliers.begin() + static_cast<std::ptrdiff_t>(most_listed);
    std::nth_element(outliers.begin(), last, outliers.end(),
                     [](const Outlier& a, const Outlier& b) { return std::abs(a.z) > std::abs(b.z); });
    outliers.erase(last, outliers.end());
  }
  std::sort(outliers.begin(), outliers.end(),
            [](const Outlier& a, const Outlier& b) { return std::pair(a.sample, a.channel) < std::pair(b.sample, b.channel); });
}

}  // namespace gonio::fitting
