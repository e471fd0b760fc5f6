// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/nuisance_rows.hpp"

#include <cmath>
#include <numbers>

#include "brdf/aperture.hpp"
#include "fitting/point_fit.hpp"

namespace gonio::fitting {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double most_tilt = 5 * degree;      // no mount is worse, and a larger one is no small correction
constexpr double most_azimuth = 45 * degree;  // beyond it the axes of an anisotropic surface change places
constexpr double most_deviations = 10;        // of a component from its stated value
constexpr double step = 1e-5;                 // radians, for central differences: a lobe of s = 1e6 is 1e-3 wide

}  // namespace

NuisanceRows::NuisanceRows(Terms& terms, const Observations& observations, const NuisanceOptions& asked,
                           const std::vector<CorrelatedComponent>& components)
    : terms_(terms) {
  const auto add_angle = [&](std::size_t k, double bound) {
    axes_.push_back({std::string(Misalignment::names[k]), bound, false, 1 / degree, k, {}});
  };
  if (asked.tilt) add_angle(0, most_tilt), add_angle(1, most_tilt);
  if (asked.azimuth) add_angle(2, most_azimuth);
  if (asked.components)
    for (const CorrelatedComponent& component : components) {
      NuisanceAxis axis{component.name, most_deviations, true, component.u, 0, {}};
      for (const std::size_t sample : terms.sample)
        axis.factor_exponent.push_back(component.u * (component.sensitivity.empty() ? 1 : component.sensitivity[sample]));
      axes_.push_back(std::move(axis));
    }
  std::size_t row = 0, first = 0;
  std::vector<GonioAngles> block;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const std::size_t end = first + observations.block(b).size;
    observations.angles(b, block);
    for (; row < terms.rows() && terms.sample[row] < end; ++row) angles_.push_back(block[terms.sample[row] - first]);
    first = end;
  }
}

Misalignment NuisanceRows::misalignment(const std::vector<double>& m) const {
  Misalignment out;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (!axes_[k].with_prior) out[axes_[k].angle] = m[k];
  return out;
}

void NuisanceRows::set(const std::vector<double>& m) {
  const Misalignment next = misalignment(m);
  if (next.tilt_x != now_.tilt_x || next.tilt_y != now_.tilt_y || next.azimuth != now_.azimuth) {
    for (std::size_t row = 0; row < angles_.size(); ++row) terms_.geometry[row] = lobe_geometry(angles_[row], next);
    MeanRows means;
    std::vector<LobeGeometry> geometry;
    std::vector<double> weight;
    for (std::size_t k = 0; k < terms_.mean.row.size(); ++k) {
      geometry.clear(), weight.clear();
      const std::size_t row = terms_.mean.row[k];
      aperture_nodes(seen_by(next, angles_[row]), terms_.mean.rule[k], geometry, weight);
      if (!geometry.empty()) means.append(row, terms_.mean.rule[k], geometry, weight);
    }
    terms_.mean = std::move(means);
    now_ = next;
  }
  std::vector<double> exponent;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (!axes_[k].with_prior || m[k] == 0) continue;
    exponent.resize(terms_.rows(), 0.0);
    for (std::size_t row = 0; row < exponent.size(); ++row) exponent[row] += m[k] * axes_[k].factor_exponent[row];
  }
  for (double& value : exponent) value = std::exp(value);
  terms_.factor = std::move(exponent);
}

NuisanceRows::Slopes NuisanceRows::slopes(const std::vector<double>& m, const std::vector<std::vector<double>>& linear,
                                          const std::vector<double>& theta) {
  Slopes out(axes_.size());
  const auto here = fitted_values(terms_, linear, theta);
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (axes_[k].with_prior) {
      out[k] = here;
      for (auto& channel : out[k])
        for (std::size_t row = 0; row < channel.size(); ++row) channel[row] *= axes_[k].factor_exponent[row];
      continue;
    }
    std::vector<double> beside = m;
    beside[k] = m[k] + step;
    set(beside);
    out[k] = fitted_values(terms_, linear, theta);
    beside[k] = m[k] - step;
    set(beside);
    const auto below = fitted_values(terms_, linear, theta);
    for (std::size_t c = 0; c < below.size(); ++c)
      for (std::size_t row = 0; row < below[c].size(); ++row) out[k][c][row] = (out[k][c][row] - below[c][row]) / (2 * step);
  }
  set(m);
  return out;
}

}  // namespace gonio::fitting
