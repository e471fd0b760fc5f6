// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/guided_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "brdf/error.hpp"

namespace gonio::tabulated {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// Directions made from the same angles agree to rounding.
constexpr double same_place = 1e-6;
/// The floor is this part of a value that this part of the values lie below: where the guide is at least as large as the samples, the rest
/// is their ratio within a tenth.
constexpr double floor_part = 0.1, floor_quantile = 0.02;
/// At normal incidence an isotropic sample belongs to every azimuth; turned in steps as fine as plans are.
constexpr double at_normal = 1e-3;
constexpr int normal_turns = 36;

/// Where a sample lies, and where its partners do.
struct Placed {
  Direction wi, wo;
  std::size_t sample;
};

Direction mirrored(const Direction& d) { return Direction::trusted(d.x(), -d.y(), d.z()); }

Direction turned(const Direction& d, double cos, double sin) {
  return Direction::trusted(cos * d.x() - sin * d.y(), sin * d.x() + cos * d.y(), d.z());
}

std::vector<Placed> with_partners(const Dataset& data) {
  std::vector<Placed> out;
  for (std::size_t k = 0; k < data.size(); ++k) out.push_back({data.angles[k].wi(), data.angles[k].wo(), k});
  if (data.symmetry.reciprocal && data.side == Side::reflection)
    for (std::size_t k = 0, n = out.size(); k < n; ++k) out.push_back({out[k].wo, out[k].wi, out[k].sample});
  if (data.symmetry.isotropic)
    for (std::size_t k = 0, n = out.size(); k < n; ++k)
      if (std::hypot(out[k].wi.x(), out[k].wi.y()) < at_normal)
        for (int turn = 1; turn < normal_turns; ++turn) {
          const Angle angle = degrees(360.0 * turn / normal_turns);
          // A little off the normal towards -angle: the pair as it is seen turned to phi_i = 0.
          out.push_back({Direction::trusted(2e-9, 0, 1), turned(out[k].wo, angle.cos(), angle.sin()), out[k].sample});
        }
  if (data.symmetry.bilateral)
    for (std::size_t k = 0, n = out.size(); k < n; ++k) out.push_back({mirrored(out[k].wi), mirrored(out[k].wo), out[k].sample});
  return out;
}

bool has_value(const Dataset& data, std::size_t sample) {
  return std::any_of(data.f.begin(), data.f.end(), [&](const auto& channel) { return !std::isnan(channel[sample]); });
}

std::size_t root(std::vector<std::size_t>& parent, std::size_t k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

/// Mean of some samples of a channel.
void average(const Dataset& data, const std::vector<std::size_t>& samples, std::size_t channel, MeanSamples& out, std::size_t mean) {
  double weights = 0, f = 0, spread = 0;
  std::size_t n = 0;
  bool known = data.has_uncertainty();
  for (const std::size_t k : samples)
    if (!std::isnan(data.f[channel][k])) known = known && !std::isnan(data.u[channel][k]);
  const auto weight = [&](std::size_t k) { return known ? 1 / (data.u[channel][k] * data.u[channel][k]) : 1.0; };
  for (const std::size_t k : samples)
    if (!std::isnan(data.f[channel][k])) weights += weight(k), f += weight(k) * data.f[channel][k], ++n;
  if (n == 0) return;
  f /= weights;
  out.f[channel][mean] = n == 1 ? data.f[channel][samples.front()] : f;
  for (const std::size_t k : samples)
    if (n == 1 && !std::isnan(data.f[channel][k])) out.f[channel][mean] = data.f[channel][k];
  for (const std::size_t k : samples)
    if (!std::isnan(data.f[channel][k])) spread += weight(k) * (data.f[channel][k] - f) * (data.f[channel][k] - f);
  const double external = n > 1 ? spread / (weights * static_cast<double>(n - 1)) : 0;
  if (known) out.u[channel][mean] = std::sqrt(std::max(1 / weights, external));
  for (std::size_t c = 0; c < data.correlated.size(); ++c) {
    double sum = 0;
    for (const std::size_t k : samples)
      if (!std::isnan(data.f[channel][k]))
        sum += weight(k) * data.f[channel][k] * (data.correlated[c].sensitivity.empty() ? 1.0 : data.correlated[c].sensitivity[k]);
    out.shared[c][channel][mean] = sum / weights * data.correlated[c].u;
  }
}

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

PairPoint GuidedSamples::place(const Direction& wi, const Direction& wo) const noexcept {
  PairPoint p = pair_point(wi, wo, isotropic);
  p[0] /= spacing.s, p[1] /= spacing.s, p[2] /= spacing.t, p[3] /= spacing.t;
  return p;
}

void GuidedSamples::guide_values(const Brdf* guide, std::span<const Direction> wi, std::span<const Direction> wo,
                                 std::vector<double>& g) const {
  const std::size_t channels = floor.size();
  g.assign(wi.size() * channels, 0.0);
  if (!guide) return;
  const std::size_t given = guide->channels().size();
  std::vector<double> values(wi.size() * given);
  guide->eval(wi, wo, values);
  for (std::size_t k = 0; k < wi.size(); ++k)
    for (std::size_t c = 0; c < channels; ++c)
      if (const double value = values[k * given + (given == 1 ? 0 : c)]; value > 0 && std::isfinite(value)) g[k * channels + c] = value;
}

GuidedSamples guided_samples(const Dataset& data, const Brdf* guide) {
  const std::size_t channels = data.channels.size();
  GuidedSamples out;
  out.isotropic = data.symmetry.isotropic;

  std::vector<PairPoint> raw, blocked;
  for (std::size_t k = 0; k < data.size(); ++k)
    if (has_value(data, k)) raw.push_back(pair_point(data.angles[k].wi(), data.angles[k].wo(), out.isotropic));
  if (raw.empty()) throw Error(ErrorKind::input, {"the samples", "none with a value", "at least one"});
  out.spacing = sample_spacing(raw);

  std::vector<Placed> placed;
  std::vector<PairPoint> points;
  for (const Placed& p : with_partners(data)) {
    const PairPoint point = out.place(p.wi, p.wo);
    if (has_value(data, p.sample))
      placed.push_back(p), points.push_back(point);
    else
      blocked.push_back(point);
  }
  out.masked = std::make_shared<const NeighbourTree>(std::move(blocked));

  // Samples that meet at one place are one, and so are all places of the one.
  std::vector<std::size_t> parent(data.size()), founder(points.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const NeighbourTree all(points);
  std::vector<Neighbour> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    all.around(points[k], {.most = points.size(), .reach = same_place / out.spacing.s, .hidden = 0}, found);
    founder[k] = k;
    for (const Neighbour& other : found) {
      founder[k] = std::min(founder[k], other.point);
      parent[root(parent, placed[other.point].sample)] = root(parent, placed[k].sample);
    }
  }
  std::vector<std::size_t> mean_of_root(data.size(), data.size());
  std::vector<std::vector<std::size_t>> samples;
  std::size_t position = 0;
  for (std::size_t k = 0; k < data.size(); ++k) {
    if (!has_value(data, k)) continue;
    std::size_t& mean = mean_of_root[root(parent, k)];
    if (mean == data.size()) {
      mean = samples.size();
      samples.emplace_back();
      out.means.incidence.push_back(out.spacing.incidence[position]);
    }
    samples[mean].push_back(k);
    ++position;
  }
  out.means.f.assign(channels, std::vector(samples.size(), nan));
  out.means.u = out.means.f;
  out.means.shared.assign(data.correlated.size(), std::vector(channels, std::vector(samples.size(), 0.0)));
  for (std::size_t mean = 0; mean < samples.size(); ++mean)
    for (std::size_t c = 0; c < channels; ++c) average(data, samples[mean], c, out.means, mean);

  std::vector<PairPoint> kept;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (founder[k] == k) {
      kept.push_back(points[k]), out.incident.push_back(placed[k].wi), out.outgoing.push_back(placed[k].wo);
      out.mean_of.push_back(mean_of_root[root(parent, placed[k].sample)]);
    }
  out.places = std::make_shared<const NeighbourTree>(std::move(kept));
  return with_guide(std::move(out), guide);
}

GuidedSamples with_guide(GuidedSamples out, const Brdf* guide) {
  const std::size_t channels = out.means.f.size(), places = out.mean_of.size();
  if (guide && guide->channels().size() != channels && guide->channels().size() != 1)
    throw Error(ErrorKind::usage, {"the guide", fmt::format("{} channels", guide->channels().size()), fmt::format("{} or 1", channels)});
  out.floor.clear();
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<double> sizes;
    for (const double f : out.means.f[c])
      if (std::fabs(f) > 0) sizes.push_back(std::fabs(f));
    out.floor.push_back(sizes.empty() ? 1.0
                        : guide       ? floor_part * quantile(std::move(sizes), floor_quantile)
                                      : quantile(std::move(sizes), 0.5));
  }

  std::vector<double> g;
  out.guide_values(guide, out.incident, out.outgoing, g);
  out.rest.assign(channels, std::vector<double>(places));
  out.scale = out.log_scale = out.rest;
  for (std::size_t k = 0; k < places; ++k)
    for (std::size_t c = 0; c < channels; ++c) {
      out.scale[c][k] = g[k * channels + c] + out.floor[c];
      out.log_scale[c][k] = std::log(out.scale[c][k]);
      out.rest[c][k] = (out.means.f[c][out.mean_of[k]] - g[k * channels + c]) / out.scale[c][k];
    }
  return out;
}

}  // namespace gonio::tabulated
