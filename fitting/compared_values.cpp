// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/compared_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/error.hpp"
#include "fitting/checks/sample_places.hpp"

namespace gonio::fitting {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string joined(const Channels& channels) {
  std::string out;
  for (const Channel& channel : channels) out += (out.empty() ? "" : ", ") + channel.name;
  return out;
}

void resize(ComparedSide& side, std::size_t channels, bool with_u, std::size_t components) {
  side.f.resize(channels);
  if (with_u) side.u.resize(channels);
  side.shared.assign(components, std::vector<std::vector<double>>(channels));
}

/// Means of the samples of one place, or NaN.
void append_mean(ComparedSide& side, const Dataset& dataset, const std::vector<std::size_t>& samples, std::size_t from, std::size_t to) {
  const auto mean = mean_of(dataset, from, samples);
  side.f[to].push_back(mean ? mean->f : unknown);
  if (!side.u.empty()) side.u[to].push_back(mean ? mean->u : unknown);
  for (std::size_t k = 0; k < side.shared.size(); ++k) side.shared[k][to].push_back(mean ? mean->shared[k] : unknown);
}

struct PlacedSamples {
  Places places;
  std::vector<std::vector<std::size_t>> samples;  ///< [place]
};

PlacedSamples placed(const Dataset& dataset, bool turned) {
  PlacedSamples out;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const std::size_t place = out.places.add(turned ? key_turned(dataset.angles[k]) : key_of(dataset.angles[k]));
    out.samples.resize(out.places.size());
    out.samples[place].push_back(k);
  }
  return out;
}

/// Fills `out` with the common places; false if they are too few to stand for the data sets.
bool common_places(const Dataset& a, const Dataset& b, ComparedValues& out) {
  const PlacedSamples at_a = placed(a, out.isotropic), at_b = placed(b, out.isotropic);
  std::vector<std::pair<std::size_t, std::size_t>> common;
  for (std::size_t place = 0; place < at_a.samples.size(); ++place) {
    const GonioAngles& angles = a.angles[at_a.samples[place].front()];
    if (const auto other = at_b.places.find(out.isotropic ? key_turned(angles) : key_of(angles))) common.emplace_back(place, *other);
  }
  if (common.empty() || 2 * common.size() < std::min(at_a.samples.size(), at_b.samples.size())) return false;
  out.at = ComparedAt::common_directions;
  out.without_partner = at_a.samples.size() - common.size();
  resize(out.a, out.channels.size(), a.has_uncertainty(), a.correlated.size());
  resize(out.b, out.channels.size(), b.has_uncertainty(), b.correlated.size());
  for (const auto& [place, other] : common) {
    out.angles.push_back(a.angles[at_a.samples[place].front()]);
    for (std::size_t c = 0; c < out.channels.size(); ++c) {
      append_mean(out.a, a, at_a.samples[place], out.channels[c].a, c);
      append_mean(out.b, b, at_b.samples[other], out.channels[c].b, c);
    }
  }
  return true;
}

/// The samples of a data set, one by one.
void take_samples(const Dataset& dataset, const std::vector<ComparedChannel>& channels, std::size_t ComparedChannel::*which,
                  ComparedSide& side) {
  resize(side, channels.size(), dataset.has_uncertainty(), dataset.correlated.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::size_t from = channels[c].*which;
    side.f[c] = dataset.f[from];
    if (dataset.has_uncertainty()) side.u[c] = dataset.u[from];
    for (std::size_t k = 0; k < dataset.correlated.size(); ++k) {
      const CorrelatedComponent& component = dataset.correlated[k];
      for (std::size_t s = 0; s < dataset.size(); ++s)
        side.shared[k][c].push_back(dataset.f[from][s] * component.u * (component.sensitivity.empty() ? 1 : component.sensitivity[s]));
    }
  }
}

void evaluate(const Brdf& brdf, const std::vector<GonioAngles>& angles, const std::vector<ComparedChannel>& channels,
              std::size_t ComparedChannel::*which, ComparedSide& side) {
  constexpr std::size_t at_once = 4096;
  const std::size_t count = brdf.channels().size();
  side.f.assign(channels.size(), {});
  for (auto& values : side.f) values.reserve(angles.size());
  std::vector<Direction> wi, wo;
  std::vector<double> f;
  for (std::size_t first = 0; first < angles.size(); first += at_once) {
    const std::size_t n = std::min(at_once, angles.size() - first);
    wi.clear(), wo.clear();
    for (std::size_t k = 0; k < n; ++k) wi.push_back(angles[first + k].wi()), wo.push_back(angles[first + k].wo());
    f.resize(n * count);
    brdf.eval(wi, wo, f);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < channels.size(); ++c) side.f[c].push_back(f[k * count + channels[c].*which]);
  }
}

/// Midpoints over theta_h (equal steps of its root), theta_d, phi_d and, for anisotropic BRDFs, phi_h.
void fill_quadrature(ComparedValues& out, Angle theta_max) {
  constexpr double pi = std::numbers::pi;
  const int h = 90, d = out.isotropic ? 45 : 24, p = out.isotropic ? 72 : 36, turns = out.isotropic ? 1 : 8;
  const double lowest = theta_max.cos();
  for (int ih = 0; ih < h; ++ih) {
    const double root = (ih + 0.5) / h, theta_h = root * root * pi / 2, step_h = root / h * pi;
    for (int id = 0; id < d; ++id) {
      const double theta_d = (id + 0.5) / d * pi / 2;
      const double measure =
          4 * std::cos(theta_d) * std::sin(theta_d) * std::sin(theta_h) * step_h * (pi / 2 / d) * (2 * pi / p) * (2 * pi / turns);
      for (int ip = 0; ip < p; ++ip)
        for (int turn = 0; turn < turns; ++turn) {
          const DirectionPair pair = directions(
              HalfDifference{radians(theta_h), radians(2 * pi * (turn + 0.5) / turns), radians(theta_d), radians(2 * pi * (ip + 0.5) / p)});
          if (pair.wi.z() < lowest || pair.wo.z() < lowest) continue;
          GonioAngles angles = gonio_angles(pair.wi, pair.wo);
          if (out.isotropic) angles.phi_o = angles.phi_o - angles.phi_i, angles.phi_i = degrees(0);
          out.angles.push_back(angles);
          out.weight.push_back(measure);
        }
    }
  }
}

}  // namespace

const char* name(ComparedAt at) noexcept {
  switch (at) {
    case ComparedAt::common_directions: return "common-directions";
    case ComparedAt::samples_of_a: return "samples-of-a";
    case ComparedAt::samples_of_b: return "samples-of-b";
    case ComparedAt::quadrature: return "quadrature";
  }
  return "";
}

std::vector<ComparedChannel> matched_channels(const Channels& a, const Channels& b) {
  std::vector<ComparedChannel> out;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (a[k].name == b[j].name) out.push_back({a[k].name, k, j});
  if (!out.empty()) return out;
  if (b.size() == 1)
    for (std::size_t k = 0; k < a.size(); ++k) out.push_back({a[k].name, k, 0});
  else if (a.size() == 1)
    for (std::size_t k = 0; k < b.size(); ++k) out.push_back({b[k].name, 0, k});
  if (out.empty())
    throw Error(ErrorKind::input, {"channels", fmt::format("{} in A and {} in B", joined(a), joined(b)),
                                   "a channel of the same name on both sides, or a single one on one side"});
  return out;
}

ComparedValues compared_values(const CompareSubject& a, const CompareSubject& b, Angle theta_max) {
  ComparedValues out;
  out.channels = matched_channels(a.channels(), b.channels());
  out.isotropic = a.symmetry().isotropic && b.symmetry().isotropic;
  if (a.dataset && b.dataset && common_places(*a.dataset, *b.dataset, out)) {
    out.weight.assign(out.angles.size(), 1.0);
    return out;
  }
  if (a.dataset && b.brdf) {
    out.at = ComparedAt::samples_of_a;
    out.other_is_samples = b.dataset != nullptr;
    out.angles = a.dataset->angles;
    out.weight.assign(out.angles.size(), 1.0);
    take_samples(*a.dataset, out.channels, &ComparedChannel::a, out.a);
    evaluate(*b.brdf, out.angles, out.channels, &ComparedChannel::b, out.b);
  } else if (b.dataset && a.brdf) {
    out.at = ComparedAt::samples_of_b;
    out.angles = b.dataset->angles;
    out.weight.assign(out.angles.size(), 1.0);
    evaluate(*a.brdf, out.angles, out.channels, &ComparedChannel::a, out.a);
    take_samples(*b.dataset, out.channels, &ComparedChannel::b, out.b);
  } else if (a.brdf && b.brdf) {
    fill_quadrature(out, theta_max);
    evaluate(*a.brdf, out.angles, out.channels, &ComparedChannel::a, out.a);
    evaluate(*b.brdf, out.angles, out.channels, &ComparedChannel::b, out.b);
  } else {
    throw Error(ErrorKind::input, {"A and B", "no common direction, and neither can be evaluated", "something to compare at"});
  }
  return out;
}

}  // namespace gonio::fitting
