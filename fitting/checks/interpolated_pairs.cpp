// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/interpolated_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "fitting/checks/fitted_model.hpp"
#include "fitting/checks/local_interpolation.hpp"
#include "fitting/checks/repeatability.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t groups = 8;         // of theta_h, for the interpolation error
constexpr double least_own_weight = 0.5;  // of the sample in its own difference: below, its partner is mostly itself

/// One channel of one data set.
struct Channelled {
  std::vector<Reading> readings;  ///< one per sample with a value
  std::vector<double> model;      ///< at the readings, > 0
  std::vector<GonioAngles> angles;
  std::vector<std::size_t> sample;
};

Channelled readings_of(const Dataset& dataset, std::size_t channel, const Brdf* model, std::size_t first, std::size_t components) {
  Channelled out;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const Direction wi = dataset.angles[k].wi(), wo = dataset.angles[k].wo();
    if (!(wi.z() > 0 && wo.z() > 0)) continue;
    auto reading = reading_of(dataset, channel, {k}, first, components);
    const double m = model ? model->eval(wi, wo)[channel] : 1;
    if (!reading || !(m > 0)) continue;
    out.readings.push_back(std::move(*reading));
    out.model.push_back(m);
    out.angles.push_back(dataset.angles[k]);
    out.sample.push_back(k);
  }
  return out;
}

/// f(reading) - interpolated value for the weights, the reading's own share collected.
std::vector<Contrast::Term> difference(const Channelled& data, std::size_t reading, const LocalInterpolation::Weights& weights) {
  std::map<std::size_t, double> terms;
  terms[reading] = 1;
  for (const auto& [node, weight] : weights) terms[node] -= weight * data.model[reading] / data.model[node];
  std::vector<Contrast::Term> out{{reading, terms[reading]}};
  for (const auto& [node, weight] : terms)
    if (node != reading) out.push_back({node, weight});
  return out;
}

/// What samples differ from their neighbours by: c² and its variance from noise, relative to the model squared.
struct Residual {
  double theta_h, square, variance;
};

/// The relative interpolation variance as a function of theta_h: group ends and values.
class InterpolationVariance {
 public:
  explicit InterpolationVariance(std::vector<Residual> residuals) {
    std::sort(residuals.begin(), residuals.end(), [](const Residual& a, const Residual& b) { return a.theta_h < b.theta_h; });
    for (std::size_t g = 0; g < groups && !residuals.empty(); ++g) {
      const std::size_t begin = g * residuals.size() / groups, end = (g + 1) * residuals.size() / groups;
      double excess = 0;
      for (std::size_t k = begin; k < end; ++k) excess += (residuals[k].square - residuals[k].variance) / static_cast<double>(end - begin);
      if (end == begin) continue;
      upper_.push_back(residuals[end - 1].theta_h);
      value_.push_back(std::isfinite(excess) ? std::max(0.0, excess) : 0);
    }
  }
  bool known() const { return !value_.empty(); }
  double at(double theta_h) const {
    const auto group = std::lower_bound(upper_.begin(), upper_.end(), theta_h);
    return group == upper_.end() ? value_.back() : value_[static_cast<std::size_t>(group - upper_.begin())];
  }

 private:
  std::vector<double> upper_, value_;
};

/// The weights of every reading's neighbours at other incidences, and of its partner's surroundings: the same for every channel that
/// has a value in the same samples.
struct Surroundings {
  std::vector<std::size_t> sample;
  std::vector<std::optional<LocalInterpolation::Weights>> own, partner;

  explicit Surroundings(const Channelled& data) : sample(data.sample) {
    const LocalInterpolation interpolation(data.angles);
    for (std::size_t r = 0; r < data.angles.size(); ++r) {
      // A partner's incidence was hardly ever measured: leave out all of this one's, or the error between incidences stays unseen.
      const double theta_i = data.angles[r].theta_i.radians();
      own.push_back(interpolation.at(data.angles[r], [&](std::size_t other) {
        return other == r || std::abs(data.angles[other].theta_i.radians() - theta_i) <= same_direction_rad;
      }));
      partner.push_back(interpolation.at(exchanged(data.angles[r])));
    }
  }
};

std::vector<Residual> neighbour_residuals(const Channelled& data, const Surroundings& surroundings, std::vector<double>& scatter) {
  std::vector<Residual> residuals;
  for (std::size_t r = 0; r < data.readings.size(); ++r) {
    if (!surroundings.own[r]) continue;
    double c = 0, variance = 0;
    for (const auto& [reading, weight] : difference(data, r, *surroundings.own[r])) {
      c += weight * data.readings[reading].f;
      variance += weight * weight * data.readings[reading].u * data.readings[reading].u;
    }
    const double m2 = data.model[r] * data.model[r];
    residuals.push_back({half_difference(data.angles[r]).theta_h.radians(), c * c / m2, variance / m2});
    if (data.readings[r].f > 0) scatter.push_back(std::abs(c) / data.readings[r].f);
  }
  return residuals;
}

}  // namespace

InterpolatedPairs interpolated_partners(const std::vector<std::shared_ptr<const Dataset>>& datasets, const Patterns& patterns,
                                        const std::vector<std::string>& pattern_names, const std::vector<double>& pattern_share) {
  InterpolatedPairs out;
  out.set.pattern_names = pattern_names;
  out.set.pattern_share = pattern_share;
  out.with_model = !datasets.empty();
  const auto first = first_components(datasets);
  std::vector<double> scatter;
  double noise = 0, interpolated = 0, mean2 = 0;
  std::size_t first_place = 0;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const Dataset& dataset = *datasets[d];
    const auto model = fitted_model(datasets[d]);
    const std::vector<double> time = parts_of_time(dataset);
    out.with_model = out.with_model && model;
    std::optional<Surroundings> surroundings;
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      Channelled data = readings_of(dataset, c, model.get(), first[d], first.back());
      if (!surroundings || surroundings->sample != data.sample) surroundings.emplace(data);
      const InterpolationVariance error(neighbour_residuals(data, *surroundings, scatter));
      if (!error.known()) continue;
      const std::size_t base = out.set.readings.size();
      for (std::size_t r = 0; r < data.readings.size(); ++r) {
        const GonioAngles partner = exchanged(data.angles[r]);
        const auto& weights = surroundings->partner[r];
        if (!weights) continue;
        Contrast contrast;
        contrast.terms = difference(data, r, *weights);
        if (contrast.terms[0].weight < least_own_weight) continue;
        double value = 0, variance = 0;
        for (auto& [reading, weight] : contrast.terms) {
          value += weight * data.readings[reading].f;
          if (reading != r) variance += weight * weight * data.readings[reading].u * data.readings[reading].u;
          reading += base;
        }
        contrast.mean = data.readings[r].f - value / 2;
        contrast.scale = std::abs(contrast.mean);
        contrast.u_interpolation = data.model[r] * std::sqrt(error.at(half_difference(partner).theta_h.radians()));
        contrast.place = first_place + data.sample[r];
        const auto here = patterns(data.angles[r], time[data.sample[r]]);
        contrast.pattern.assign(here.size(), 0.0);
        for (std::size_t p = 0; p < here.size(); ++p) contrast.pattern[p] = contrast.mean * here[p];
        for (const auto& [node, weight] : *weights) {
          const auto there = patterns(data.angles[node], time[data.sample[node]]);
          for (std::size_t p = 0; p < there.size(); ++p) contrast.pattern[p] -= contrast.mean * weight * there[p];
        }
        noise += variance, interpolated += contrast.u_interpolation * contrast.u_interpolation, mean2 += contrast.scale * contrast.scale;
        out.set.contrasts.push_back(std::move(contrast));
      }
      std::move(data.readings.begin(), data.readings.end(), std::back_inserter(out.set.readings));
    }
    first_place += dataset.size();
  }
  if (mean2 > 0) out.u_noise = std::sqrt(noise / mean2), out.u_interpolation = std::sqrt(interpolated / mean2);
  out.neighbours = scatter.size();
  out.neighbour_scatter = median_of(std::move(scatter));
  return out;
}

}  // namespace gonio::fitting
