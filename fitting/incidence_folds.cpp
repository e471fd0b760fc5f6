// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/incidence_folds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace gonio::fitting {
namespace {

constexpr double same_incidence_deg = 0.25;
constexpr double widest_incidence_deg = 1;
/// A fold of fewer samples says nothing.
constexpr std::size_t least_samples = 4;

struct Zeniths {
  std::vector<double> in_deg, out_deg;  ///< NaN where there is no measurement
};

Zeniths zeniths_of(const Observations& observations) {
  Zeniths out;
  std::vector<GonioAngles> angles;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    observations.angles(b, angles);
    for (std::size_t k = 0; k < block.size; ++k) {
      const bool measured =
          block.valid(k) && std::any_of(block.f.begin(), block.f.end(), [&](const Column& f) { return std::isfinite(f[k]); });
      out.in_deg.push_back(measured ? std::abs(angles[k].theta_i.degrees()) : NAN);
      out.out_deg.push_back(measured ? std::abs(angles[k].theta_o.degrees()) : NAN);
    }
  }
  return out;
}

std::vector<double> sorted_finite(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out), [](double value) { return std::isfinite(value); });
  std::sort(out.begin(), out.end());
  return out;
}

/// The lower ends of the clusters of sorted values, or nothing if one of them is too wide to be a single incidence.
std::optional<std::vector<double>> incidences_in(const std::vector<double>& sorted) {
  std::vector<double> begins{sorted.front()};
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k] - sorted[k - 1] > same_incidence_deg) begins.push_back(sorted[k]);
    if (sorted[k] - begins.back() > widest_incidence_deg) return std::nullopt;
  }
  return begins;
}

/// The lower ends of `count` bins of equally many sorted values; fewer where values are equal.
std::vector<double> bins_of(const std::vector<double>& sorted, std::size_t count) {
  std::vector<double> begins;
  for (std::size_t k = 0; k < count; ++k) begins.push_back(sorted[k * sorted.size() / count]);
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  return begins;
}

}  // namespace

std::string description(const Folds& folds) {
  switch (folds.over) {
    case Folds::Over::incidences: return fmt::format("leave one incidence out ({} incidences)", folds.count);
    case Folds::Over::incidence_groups: return fmt::format("{} folds of {} incidences", folds.count, folds.places);
    case Folds::Over::incidence_bins: return fmt::format("leave one of {} bins of incidence out", folds.count);
    case Folds::Over::outgoing_bins:
      return fmt::format("{} folds of outgoing zenith angles, for there is one incidence only: other incidences stay unknown", folds.count);
    case Folds::Over::nothing: break;
  }
  return "none, for there are too few samples";
}

Folds incidence_folds(const Observations& observations, std::size_t max_folds) {
  const Zeniths zeniths = zeniths_of(observations);
  const std::vector<double> incident = sorted_finite(zeniths.in_deg);
  Folds out;
  out.of_sample.assign(zeniths.in_deg.size(), Folds::none);
  if (incident.size() < 2 * least_samples) return out;

  std::vector<double> begins;
  const std::vector<double>* by = &zeniths.in_deg;
  if (const auto found = incidences_in(incident); !found) {
    out.over = Folds::Over::incidence_bins;
    begins = bins_of(incident, max_folds);
  } else if (found->size() > 1) {
    begins = *found;
    out.over = begins.size() <= max_folds ? Folds::Over::incidences : Folds::Over::incidence_groups;
  } else {
    const std::vector<double> outgoing = sorted_finite(zeniths.out_deg);
    out.over = Folds::Over::outgoing_bins;
    by = &zeniths.out_deg;
    begins = bins_of(outgoing, std::min(2 * max_folds, outgoing.size() / least_samples));
  }
  out.places = begins.size();
  out.count = std::min(out.places, max_folds);
  if (out.over == Folds::Over::outgoing_bins) out.count = std::min((out.places + 1) / 2, max_folds);  // neighbours in different folds
  if (out.count < 2) {
    out.over = Folds::Over::nothing;
    out.count = 0;
    return out;
  }
  for (std::size_t k = 0; k < by->size(); ++k) {
    if (!std::isfinite((*by)[k])) continue;
    const auto place = std::upper_bound(begins.begin(), begins.end(), (*by)[k]) - begins.begin() - 1;
    out.of_sample[k] = static_cast<std::uint8_t>(static_cast<std::size_t>(place) % out.count);
  }
  return out;
}

}  // namespace gonio::fitting
