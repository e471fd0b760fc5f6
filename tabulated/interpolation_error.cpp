// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/interpolation_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "tabulated/convex_hull.hpp"
#include "tabulated/in_parallel.hpp"

namespace gonio::tabulated {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array tried_ranges{1.0, 2.0, 4.0, 8.0, 16.0};
constexpr CorrelationRanges usual_ranges{4, 4};
/// Enough predictions to choose among the ranges; the errors of all samples are found afterwards.
constexpr std::size_t most_single = 300, most_incidence = 150, fewest = 12;
constexpr std::size_t most_channels = 3;  ///< that choose the ranges
constexpr int student_freedom = 4;
/// Neighbours whose own misses say how rough the field is here, and the weight of the field's average beside them.
constexpr std::size_t local_neighbours = 8;
constexpr double local_prior = 4;
constexpr double z_95 = 1.959964;
constexpr double least_variance = 1e-16;  ///< of y: what rounding leaves of an exact guide
constexpr double hull_tolerance = 0.3;    ///< steps

/// A sample to be predicted from others.
struct Case {
  std::size_t place;
  std::vector<std::size_t> from;  ///< places
  std::vector<PairPoint> points;
};

std::optional<Case> left_out(const GuidedSamples& samples, std::size_t place, const std::function<bool(std::size_t)>& leave) {
  std::vector<Neighbour> found;
  const PairPoint& at = (*samples.places)[place];
  samples.places->around(at, {.most = kriging_neighbours, .reach = kriging_reach, .leave = &leave}, found);
  if (found.empty()) return std::nullopt;
  Case out{place, {}, {}};
  for (const Neighbour& neighbour : found) out.from.push_back(neighbour.point), out.points.push_back((*samples.places)[neighbour.point]);
  return out;
}

std::optional<Case> without_itself(const GuidedSamples& samples, std::size_t place) {
  return left_out(samples, place, [&](std::size_t other) { return samples.mean_of[other] == samples.mean_of[place]; });
}

std::optional<Case> without_its_incidence(const GuidedSamples& samples, std::size_t place) {
  const std::size_t incidence = samples.means.incidence[samples.mean_of[place]];
  return left_out(samples, place, [&](std::size_t other) { return samples.means.incidence[samples.mean_of[other]] == incidence; });
}

/// The first place of every mean, where the sample itself was taken.
std::vector<std::size_t> first_places(const GuidedSamples& samples) {
  std::vector<std::size_t> out(samples.means.size(), samples.places->size());
  for (std::size_t place = samples.places->size(); place-- > 0;) out[samples.mean_of[place]] = place;
  return out;
}

std::vector<Case> cases_of(const GuidedSamples& samples, const std::vector<std::size_t>& places) {
  std::vector<Case> out;
  const auto add = [&](std::size_t most, const auto& predict) {
    const std::size_t stride = 1 + places.size() / most;
    for (std::size_t k = 0; k < places.size(); k += stride)
      if (std::optional<Case> one = predict(samples, places[k]);
          one && within_hull((*samples.places)[places[k]], one->points, hull_tolerance))
        out.push_back(std::move(*one));
  };
  add(most_single, without_itself);
  if (samples.spacing.gridded && samples.spacing.incidences > 2) add(most_incidence, without_its_incidence);
  return out;
}

/// What one case says about one channel: its miss, the noise in it, the variance of kriging, and how far the guide bends.
struct Miss {
  double squared, known_noise, noise_factor, kriging, bend;
};

double squared_bend(const GuidedSamples& samples, std::size_t channel, double scale, std::span<const std::size_t> places,
                    const KrigingWeights& weights) {
  double bend = std::log(scale);
  for (std::size_t k = 0; k < places.size(); ++k) bend -= weights.weight[k] * samples.log_scale[channel][places[k]];
  return bend * bend;
}

double known_variance(const GuidedSamples& samples, std::size_t channel, std::size_t place) {
  const double u = samples.means.u[channel][samples.mean_of[place]] / samples.scale[channel][place];
  return u * u;
}

std::optional<Miss> miss_of(const GuidedSamples& samples, const Case& one, const KrigingWeights& weights, std::size_t channel) {
  const auto& y = samples.rest[channel];
  if (std::isnan(y[one.place])) return std::nullopt;
  Miss out{0, known_variance(samples, channel, one.place), 1, weights.variance,
           squared_bend(samples, channel, samples.scale[channel][one.place], one.from, weights)};
  double predicted = 0;
  for (std::size_t k = 0; k < one.from.size(); ++k) {
    if (std::isnan(y[one.from[k]])) return std::nullopt;
    const double squared = weights.weight[k] * weights.weight[k];
    predicted += weights.weight[k] * y[one.from[k]];
    out.known_noise += squared * known_variance(samples, channel, one.from[k]);
    out.noise_factor += squared;
  }
  out.squared = (predicted - y[one.place]) * (predicted - y[one.place]);
  if (std::isnan(out.known_noise)) out.known_noise = 0;
  return out;
}

bool noise_unknown(const GuidedSamples& samples, std::size_t channel) {
  const auto& u = samples.means.u[channel];
  return std::any_of(u.begin(), u.end(), [](double value) { return std::isnan(value); });
}

struct Variances {
  double field = least_variance, bend = 0, noise = 0, log_likelihood = -std::numeric_limits<double>::infinity();
};

/// The logarithm of a product that is taken of many factors at a time.
class LogOfProduct {
 public:
  /// Factors lie between 1e-100 and 1e100.
  void multiply(double factor) {
    product_ *= factor;
    if (product_ < 1e-100 || product_ > 1e100) sum_ += std::log(product_), product_ = 1;
  }
  double value() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1, sum_ = 0;
};

/// Σ of -½ ln v - ½ (n + 1) ln(1 + q/(n v)) with n = 4: of ½ (4 ln v - 5 ln(v + q/4)).
double log_likelihood(const std::vector<Miss>& misses, const Variances& v) {
  static_assert(student_freedom == 4);
  LogOfProduct out;
  for (const Miss& miss : misses) {
    const double variance = v.field * miss.kriging + v.bend * miss.bend + miss.known_noise + v.noise * miss.noise_factor + least_variance;
    const double ratio = variance / (variance + miss.squared / student_freedom);
    out.multiply(ratio * ratio * (ratio * ratio) / (variance + miss.squared / student_freedom));
  }
  return 0.5 * out.value();
}

/// The variances that make the misses likeliest: the best of a coarse grid.
Variances likeliest(const std::vector<Miss>& misses, bool unknown) {
  Variances best;
  double sum = 0;
  for (const Miss& miss : misses) sum += miss.squared;
  const double typical = std::max(sum / static_cast<double>(std::max<std::size_t>(1, misses.size())), least_variance);
  static constexpr std::array<double, 6> noises{0, 0.01, 0.1, 1, 10, 100};              // in parts of the field's variance
  static constexpr std::array<double, 8> bends{0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1, 10};  // 1: a guide wrong by as much as it bends
  for (int step = -12; step <= 6; ++step)
    for (const double bend : bends)
      for (std::size_t k = 0; k < (unknown ? noises.size() : 1); ++k) {
        const double field = typical * std::pow(2.5, step);
        Variances tried{field, bend, field * noises[k]};
        tried.log_likelihood = log_likelihood(misses, tried);
        if (tried.log_likelihood > best.log_likelihood) best = tried;
      }
  return best;
}

/// Down from the grid, one variance after the other, by ever smaller factors.
Variances refined(const std::vector<Miss>& misses, Variances best) {
  for (const double factor : {1.6, 1.25, 1.1})
    for (bool better = true; better;) {
      better = false;
      for (double Variances::*variance : {&Variances::field, &Variances::bend, &Variances::noise})
        for (const double by : {factor, 1 / factor}) {
          Variances tried = best;
          tried.*variance *= by;
          tried.log_likelihood = log_likelihood(misses, tried);
          constexpr double worth_it = 1e-3;
          if (tried.log_likelihood > best.log_likelihood + worth_it) best = tried, better = true;
        }
    }
  return best;
}

std::vector<Miss> misses_of(const GuidedSamples& samples, const std::vector<Case>& cases, const std::vector<KrigingWeights>& weights,
                            std::size_t channel) {
  std::vector<Miss> out;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (const auto miss = miss_of(samples, cases[k], weights[k], channel)) out.push_back(*miss);
  return out;
}

std::vector<KrigingWeights> weights_of(const GuidedSamples& samples, const std::vector<Case>& cases, const CorrelationRanges& ranges) {
  std::vector<KrigingWeights> out(cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) ordinary_kriging((*samples.places)[cases[k].place], cases[k].points, ranges, out[k]);
  return out;
}

void choose_ranges(const GuidedSamples& samples, const std::vector<Case>& cases, int threads, InterpolationError& out) {
  const std::size_t channels = samples.floor.size(), stride = 1 + (channels - 1) / most_channels;
  std::vector<CorrelationRanges> tried;
  for (const double s : tried_ranges)
    for (const double t : tried_ranges)
      if (samples.spacing.gridded ? samples.spacing.incidences > 1 || t == usual_ranges.t : s == t) tried.push_back({s, t});
  std::vector<double> log_likelihood(tried.size(), 0.0);
  in_parallel(tried.size(), threads, [&](std::size_t k) {
    const auto weights = weights_of(samples, cases, tried[k]);
    for (std::size_t c = 0; c < channels; c += stride)
      log_likelihood[k] += likeliest(misses_of(samples, cases, weights, c), noise_unknown(samples, c)).log_likelihood;
  });
  out.ranges = tried[static_cast<std::size_t>(std::max_element(log_likelihood.begin(), log_likelihood.end()) - log_likelihood.begin())];
}

/// The factor by which the part of interpolation, and of noise that is itself an estimate, must grow for 95 % of the misses to lie within
/// their uncertainty.
double stretch(const GuidedSamples& samples, const std::vector<Case>& cases, const std::vector<KrigingWeights>& weights,
               std::size_t channel, const InterpolationError& error) {
  std::vector<double> needed;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto miss = miss_of(samples, cases[k], weights[k], channel);
    if (!miss) continue;
    const auto parts = error.parts(samples, channel, samples.scale[channel][cases[k].place], cases[k].from, weights[k]);
    const double noise = parts.noise + error.sample_variance(samples, channel, cases[k].place), squared = miss->squared / (z_95 * z_95);
    if (error.noise[channel] > 0)
      needed.push_back(squared / (noise + parts.interpolation));
    else if (parts.interpolation > 0)
      needed.push_back((squared - noise) / parts.interpolation);
  }
  if (needed.size() < fewest) return 1;
  const auto at = needed.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(needed.size()));
  std::nth_element(needed.begin(), at, needed.end());
  constexpr double least = 0.1, most = 10;  // the noise may explain all misses already; a few outliers are not the rule
  return std::clamp(*at, least, most);
}

/// NaN if none is known.
double mean_known(const std::vector<double>& values) {
  double sum = 0, n = 0;
  for (const double value : values)
    if (!std::isnan(value)) sum += value, n += 1;
  return sum / n;
}

}  // namespace

double InterpolationError::sample_variance(const GuidedSamples& samples, std::size_t channel, std::size_t place) const {
  const double known = known_variance(samples, channel, place);
  return std::isnan(known) ? noise[channel] : known;
}

InterpolationError::Parts InterpolationError::parts(const GuidedSamples& samples, std::size_t channel, double scale,
                                                    std::span<const std::size_t> places, const KrigingWeights& weights) const {
  Parts out;
  double local_sum = local_prior, local_count = local_prior;
  for (std::size_t k = 0; k < places.size(); ++k) {
    out.noise += weights.weight[k] * weights.weight[k] * sample_variance(samples, channel, places[k]);
    if (k >= local_neighbours || local.empty()) continue;
    if (const double z2 = local[channel][samples.mean_of[places[k]]]; !std::isnan(z2)) local_sum += z2, local_count += 1;
  }
  out.interpolation = (variance[channel] * weights.variance + bend[channel] * squared_bend(samples, channel, scale, places, weights)) *
                      local_sum / local_count;
  return out;
}

InterpolationError estimate_interpolation_error(const GuidedSamples& samples, int threads, std::size_t most) {
  const std::size_t channels = samples.floor.size();
  InterpolationError out;
  out.ranges = usual_ranges;
  const std::vector<std::size_t> places = first_places(samples);
  const std::vector<Case> cases = cases_of(samples, places);
  out.n_left_out = cases.size();
  if (cases.size() >= fewest) choose_ranges(samples, cases, threads, out);
  const auto weights = weights_of(samples, cases, out.ranges);
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<Miss> misses = misses_of(samples, cases, weights, c);
    if (misses.size() < fewest) {  // too few to tell: all that the samples vary by
      double sum = 0, sum2 = 0, n = 0;
      for (const double y : samples.rest[c])
        if (!std::isnan(y)) sum += y, sum2 += y * y, n += 1;
      out.variance.push_back(std::max(sum2 / n - sum * sum / (n * n), 1.0));
      out.bend.push_back(0);
      out.noise.push_back(noise_unknown(samples, c) ? nan : 0);
      continue;
    }
    const Variances found = refined(misses, likeliest(misses, noise_unknown(samples, c)));
    out.variance.push_back(found.field);
    out.bend.push_back(found.bend);
    out.noise.push_back(found.noise);
  }

  std::vector<std::vector<double>> local(channels, std::vector(samples.means.size(), nan));
  std::vector<double> squared(samples.means.size(), nan);
  std::array<std::vector<double>, 2> relative{squared, squared};
  const bool incidences = samples.spacing.gridded && samples.spacing.incidences > 2;
  const std::size_t predicted = std::min(places.size(), most);
  in_parallel(predicted, threads, [&](std::size_t number) {
    const std::size_t k = number * places.size() / predicted;
    for (const bool whole_incidence : {false, true}) {
      if (whole_incidence && !incidences) continue;
      const auto one = whole_incidence ? without_its_incidence(samples, places[k]) : without_itself(samples, places[k]);
      if (!one || !within_hull((*samples.places)[places[k]], one->points, hull_tolerance)) continue;
      KrigingWeights weights_here;
      ordinary_kriging((*samples.places)[places[k]], one->points, out.ranges, weights_here);
      for (std::size_t c = 0; c < channels; ++c)
        if (const auto miss = miss_of(samples, *one, weights_here, c)) {
          const auto parts = out.parts(samples, c, samples.scale[c][places[k]], one->from, weights_here);
          const double z2 =
              miss->squared / (parts.noise + parts.interpolation + out.sample_variance(samples, c, places[k]) + least_variance);
          local[c][k] = std::isnan(local[c][k]) ? z2 : (local[c][k] + z2) / 2;
          double& part = relative[whole_incidence ? 1 : 0][k];
          const double missed = std::sqrt(miss->squared) * samples.scale[c][places[k]] / std::fabs(samples.means.f[c][k]);
          part = (std::isnan(part) ? 0 : part) + std::min(1.0, missed) / static_cast<double>(channels);
          if (!whole_incidence) squared[k] = (std::isnan(squared[k]) ? 0 : squared[k]) + miss->squared / static_cast<double>(channels);
        }
    }
  });
  out.local = std::move(local);
  out.rms = std::sqrt(mean_known(squared));
  out.mean_alone = mean_known(relative[0]);
  out.mean_incidence = mean_known(relative[1]);
  for (std::size_t c = 0; c < channels; ++c) {
    const double factor = stretch(samples, cases, weights, c, out);
    out.variance[c] *= factor, out.bend[c] *= factor, out.noise[c] *= factor;
  }
  return out;
}

}  // namespace gonio::tabulated
