// SPDX-License-Identifier: BSD-3-Clause
// Directional albedo ∫ f cos θo dωo from scattered samples or from a function.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "brdf/brdf.hpp"

namespace gonio::fitting {

/// One sample of f at a fixed incidence.
struct AlbedoNode {
  Direction wo;
  double f = 0, u = 0;         ///< 1/sr; u NaN: unknown
  std::vector<double> shared;  ///< effect on f of one standard deviation of every shared component
  double model = 1;            ///< the fitted model there, > 0; 1 without a model
};

/// A model whose ratio to the data is smooth, at the incidence of the nodes.
struct AlbedoModel {
  std::function<double(const Direction& wo)> f;  ///< 1/sr
  double albedo = 0;                             ///< its own directional albedo, exact
};

struct AlbedoEstimate {
  double albedo = 0;         ///< over the covered part: a lower bound of the whole as long as f >= 0
  double u_noise = 0;        ///< from u of the samples; 0 if no u is known
  double u_scale = 0;        ///< from the shared components
  double u_quadrature = 0;   ///< from how much neighbouring samples differ, and from what the model is trusted with
  double covered = 0;        ///< part of the projected hemisphere within reach of a sample, 0 … 1
  double missing_bound = 0;  ///< what the rest could add: its projected solid angle times the largest value expected there

  double u() const;
};

/// Nearest-sample quadrature: the projected hemisphere is the unit disc (dA = cos θ dω), cut into equal squares; each takes from its
/// nearest sample the ratio of f to the model, times the model there, and all together are scaled to the model's exact albedo, so that a
/// lobe narrower than the squares counts right. Without a model the ratio is f itself. A square is covered if that sample is within twice
/// the median spacing of the samples (at least 1°, at most 15°).
/// The error of the rule is taken as half the spread of the three nearest ratios, all of one sign, as a rectangular distribution; and
/// as a quarter of what the model changes against the plain rule.
AlbedoEstimate scattered_albedo(const std::vector<AlbedoNode>& nodes, const AlbedoModel* model = nullptr);

/// The same of a function, by the midpoint rule in zenith and azimuth, per channel; cells where it is NaN are not covered.
/// The error of the rule is the difference to the rule with half as many points.
std::vector<AlbedoEstimate> evaluated_albedo(const Brdf& brdf, const Direction& wi);

}  // namespace gonio::fitting
