// SPDX-License-Identifier: BSD-3-Clause
// Stated and estimated noise of the meter.
#include "acquisition/meter_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio::acquisition {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fewest_readings = 5;  // below this a variance is uncertain by more than its own half
constexpr int digits_of_double = 15;        // more than a double carries through the equation is no resolution

struct Spread {
  double variance = unknown, mean = unknown, exposure_s = unknown;
};

/// Variance pooled over the visits, each about its own mean: drift between visits does not count.
Spread pooled(const std::vector<RepeatedReadings>& visits) {
  double squares = 0, sum = 0, exposures = 0;
  std::size_t readings = 0, used_visits = 0;
  for (const RepeatedReadings& visit : visits) {
    if (visit.signals.size() < 2) continue;
    double mean = 0;
    for (const double s : visit.signals) mean += s / static_cast<double>(visit.signals.size());
    for (const double s : visit.signals) squares += (s - mean) * (s - mean), sum += s, exposures += visit.exposure_s;
    readings += visit.signals.size();
    ++used_visits;
  }
  if (readings < fewest_readings || squares == 0) return {};
  const auto n = static_cast<double>(readings);
  return {squares / static_cast<double>(readings - used_visits), sum / n, exposures / n};
}

}  // namespace

NoiseModel::NoiseModel(const MeterNoise& stated, double range_w)
    : digits_(std::min(stated.digits, digits_of_double)), range_w_(range_w), origin_("stated") {
  if (stated.read_w) read_variance_ = *stated.read_w * *stated.read_w;
  if (stated.electrons_per_joule) joule_per_electron_ = 1 / *stated.electrons_per_joule;
}

NoiseModel::NoiseModel(const std::vector<RepeatedReadings>& dark, const std::vector<RepeatedReadings>& reference) {
  const Spread in_the_dark = pooled(dark), on_the_white = pooled(reference);
  read_variance_ = in_the_dark.variance;
  joule_per_electron_ = std::max(0.0, on_the_white.variance - in_the_dark.variance) * on_the_white.exposure_s / on_the_white.mean;
  if (std::isnan(on_the_white.variance) || !(on_the_white.mean > 0)) joule_per_electron_ = unknown;
  origin_ = std::isnan(read_variance_) || std::isnan(joule_per_electron_) ? "unknown" : "estimated from repeated readings";
}

double NoiseModel::variance_without_shot(double signal_w) const {
  if (digits_ == 0) return read_variance_;
  // At zero the meter shows the digits of its range.
  const double magnitude = signal_w == 0 ? range_w_ : std::abs(signal_w);
  const double last_digit = std::pow(10.0, std::floor(std::log10(magnitude)) + 1 - digits_);
  return read_variance_ + last_digit * last_digit / 12;
}

double NoiseModel::shot_variance(double signal_w, double exposure_s) const {
  return std::max(0.0, signal_w) * joule_per_electron_ / exposure_s;
}

}  // namespace gonio::acquisition
