// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/guided_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "tabulated/in_parallel.hpp"
#include "tabulated/lobe_quadrature.hpp"

namespace gonio::tabulated {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// Incidences of the energy bound.
constexpr std::size_t bound_thetas = 19, bound_phis = 13;

}  // namespace

struct GuidedTable::Scratch {
  Neighbourhoods::Box box{};
  std::shared_ptr<const Neighbourhood> of_box;  ///< null: none yet
  std::optional<Neighbourhood> of_place;
  KrigingWeights weights;
};

/// How much of the extrapolated part of the directional albedo fits below 1, on a grid of incidences.
class GuidedTable::EnergyBound {
 public:
  explicit EnergyBound(const GuidedTable& table) : channels_(table.channels().size()), phis_(table.symmetry().isotropic ? 1 : bound_phis) {
    scale_.assign(bound_thetas * phis_ * channels_, 1.0);
    in_parallel(bound_thetas * phis_, table.options_.threads, [&](std::size_t node) {
      const Direction wi = Direction::spherical(radians(theta(node / phis_)), radians(phi(node % phis_)));
      const std::vector<LobeNode> nodes = lobe_quadrature(wi);
      const std::vector<Direction> incident(nodes.size(), wi);
      std::vector<Direction> outgoing;
      for (const LobeNode& one : nodes) outgoing.push_back(one.wo);
      std::vector<double> f(nodes.size() * channels_);
      std::vector<Coverage> coverage(nodes.size());
      table.eval_all(incident, outgoing, false, f, {}, coverage);
      for (std::size_t c = 0; c < channels_; ++c) {
        double measured = 0, guessed = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k)
          if (const double part = nodes[k].weight * f[k * channels_ + c]; !std::isnan(part))
            (coverage[k] == Coverage::extrapolated ? guessed : measured) += part;
        if (measured + guessed > 1 && guessed > 0) scale_[node * channels_ + c] = std::clamp((1 - measured) / guessed, 0.0, 1.0);
      }
    });
  }

  double at(const Direction& wi, std::size_t channel) const {
    const double t = std::min(wi.theta().radians() / (std::numbers::pi / 2), 1.0) * (bound_thetas - 1);
    const double p = phis_ == 1 ? 0 : (wi.phi().radians() + std::numbers::pi) / (2 * std::numbers::pi) * static_cast<double>(phis_ - 1);
    const std::size_t row = std::min<std::size_t>(static_cast<std::size_t>(t), bound_thetas - 2);
    const std::size_t column = phis_ == 1 ? 0 : std::min<std::size_t>(static_cast<std::size_t>(p), phis_ - 2);
    const std::size_t beside = phis_ == 1 ? 0 : column + 1;
    const double x = t - static_cast<double>(row), y = p - static_cast<double>(column);
    const auto node = [&](std::size_t r, std::size_t c) { return scale_[(r * phis_ + c) * channels_ + channel]; };
    return (1 - x) * ((1 - y) * node(row, column) + y * node(row, beside)) +
           x * ((1 - y) * node(row + 1, column) + y * node(row + 1, beside));
  }

 private:
  /// Up to a hair below the horizon: at 90° itself no direction is above it.
  static double theta(std::size_t row) { return std::min(static_cast<double>(row) / (bound_thetas - 1) * std::numbers::pi / 2, 1.5707); }
  double phi(std::size_t column) const {
    return phis_ == 1 ? 0 : -std::numbers::pi + 2 * std::numbers::pi * static_cast<double>(column) / static_cast<double>(phis_ - 1);
  }

  std::size_t channels_, phis_;
  std::vector<double> scale_;
};

GuidedTable::GuidedTable(std::shared_ptr<const Dataset> samples, std::shared_ptr<const Brdf> guide, const GuidedTableOptions& options)
    : dataset_(std::move(samples)),
      guide_(std::move(guide)),
      options_(options),
      samples_(guided_samples(*dataset_, guide_.get())),
      error_(estimate_interpolation_error(samples_, options.threads)),
      neighbourhoods_(samples_, error_.ranges) {}

GuidedTable::GuidedTable(std::shared_ptr<const Dataset> samples, std::shared_ptr<const Brdf> guide, GuidedSamples guided,
                         InterpolationError error, const GuidedTableOptions& options)
    : dataset_(std::move(samples)),
      guide_(std::move(guide)),
      options_(options),
      samples_(std::move(guided)),
      error_(std::move(error)),
      neighbourhoods_(samples_, error_.ranges) {}

GuidedTable::~GuidedTable() = default;

Coverage GuidedTable::eval_pair(const Direction& wi, const Direction& wo, const double* guide, bool bounded, double* f, double* u,
                                Scratch& scratch) const {
  const std::size_t channels = samples_.floor.size();
  const PairPoint at = samples_.place(wi, wo);
  if (const auto box = Neighbourhoods::box_of(at); !scratch.of_box || box != scratch.box)
    scratch.box = box, scratch.of_box = neighbourhoods_.of(box);
  const Neighbourhood* near = scratch.of_box.get();
  if (near->crowded()) near = &scratch.of_place.emplace(neighbourhoods_.at(at));
  std::span<const std::size_t> places = near->places();
  const Neighbourhood::Nearest nearest = near->nearest(at);
  const Coverage coverage = nearest.is_here ? Coverage::measured : near->coverage(at, nearest);
  if (coverage == Coverage::extrapolated && !options_.extrapolate) {
    std::fill_n(f, channels, nan);
    if (u) std::fill_n(u, channels, nan);
    return Coverage::unknown;
  }

  if (coverage == Coverage::measured) {
    places = places.subspan(nearest.index, 1);
    scratch.weights.weight.assign(1, 1.0), scratch.weights.variance = 0;
  } else {
    near->weights_at(at, scratch.weights);
  }
  bool any = false;
  for (std::size_t c = 0; c < channels; ++c) {
    const auto& rest = samples_.rest[c];
    bool positive = true;
    double y = 0, weights = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double one = rest[places[k]], weight = scratch.weights.weight[k];
      if (std::isnan(one)) continue;
      y += weight * one, weights += weight;
      low = std::min(low, one), high = std::max(high, one);
      positive = positive && samples_.means.f[c][samples_.mean_of[places[k]]] >= 0;
    }
    constexpr double enough = 0.5;  // of the weight with a value in this channel
    if (!(weights > enough)) {
      f[c] = nan;
      if (u) u[c] = nan;
      continue;
    }
    any = true;
    y = std::clamp(y / weights, low, high);
    const double scale = guide[c] + samples_.floor[c];
    f[c] = guide[c] + scale * y;
    if (positive) f[c] = std::max(f[c], 0.0);  // where the guide falls below the floor, the rest is a difference
    if (coverage == Coverage::measured) f[c] = samples_.means.f[c][samples_.mean_of[places[0]]];
    const double energy = coverage == Coverage::extrapolated && bounded ? energy_bound().at(wi, c) : 1;
    f[c] *= energy;
    if (!u) continue;
    if (coverage == Coverage::measured && std::isnan(samples_.means.u[c][samples_.mean_of[places[0]]])) {
      u[c] = nan;
      continue;
    }
    const auto parts = error_.parts(samples_, c, scale, places, scratch.weights);
    double variance = scale * scale * (parts.noise + parts.interpolation);
    for (const auto& component : samples_.means.shared) {
      double part = 0;
      for (std::size_t k = 0; k < places.size(); ++k)
        part += scratch.weights.weight[k] * component[c][samples_.mean_of[places[k]]] * scale / samples_.scale[c][places[k]];
      variance += part * part;
    }
    u[c] = energy * std::sqrt(variance);
  }
  return any ? coverage : Coverage::unknown;
}

void GuidedTable::eval_all(std::span<const Direction> wi, std::span<const Direction> wo, bool bounded, std::span<double> f,
                           std::span<double> u, std::span<Coverage> coverage) const {
  const std::size_t channels = samples_.floor.size();
  std::vector<double> guide;
  samples_.guide_values(guide_.get(), wi, wo, guide);
  Scratch scratch;
  const bool transmission = dataset_->side == Side::transmission;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    double* values = f.data() + k * channels;
    double* uncertainties = u.empty() ? nullptr : u.data() + k * channels;
    Coverage how = Coverage::unknown;
    if (!(wi[k].z() > 0) || (transmission ? !(wo[k].z() < 0) : !(wo[k].z() > 0))) {
      std::fill_n(values, channels, 0.0);
      if (uncertainties) std::fill_n(uncertainties, channels, nan);
    } else {
      how = eval_pair(wi[k], wo[k], guide.data() + k * channels, bounded, values, uncertainties, scratch);
    }
    if (!coverage.empty()) coverage[k] = how;
  }
}

void GuidedTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  eval_all(wi, wo, true, f, {}, {});
}

void GuidedTable::eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f,
                                        std::span<double> u, std::span<Coverage> coverage) const {
  eval_all(wi, wo, true, f, u, coverage);
}

const GuidedTable::EnergyBound& GuidedTable::energy_bound() const {
  std::call_once(energy_once_, [&] { energy_ = std::make_unique<const EnergyBound>(*this); });
  return *energy_;
}

std::vector<double> GuidedTable::energy_scale(const Direction& wi) const {
  std::vector<double> out;
  for (std::size_t c = 0; c < samples_.floor.size(); ++c) out.push_back(energy_bound().at(wi, c));
  return out;
}

}  // namespace gonio::tabulated
