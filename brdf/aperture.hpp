// SPDX-License-Identifier: BSD-3-Clause
// A reading is the mean of f over the source's and the receiver's aperture: directions and weights for that mean.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/coordinates.hpp"
#include "brdf/lobe_geometry.hpp"

namespace gonio {

/// A point of a cubature on the unit disc; the weights of a rule add up to 1.
struct DiscNode {
  double radius = 0, azimuth = 0;  ///< radius in [0, 1]
  double weight = 1;
};

/// `order` = 0: the centre alone. Otherwise Gauss-Legendre in radius² with `order` points times 4 · order equal azimuths: exact for
/// polynomials of degree 4 · order - 1 (the product rule of A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971,
/// section 2.6). 4, 16, 36 … nodes.
std::vector<DiscNode> disc_rule(int order);

/// Half-angles of the cones seen from the sample [rad] with the order of the rule that integrates over each; 0 for a point.
struct ApertureRule {
  double source = 0, receiver = 0;
  int source_order = 0, receiver_order = 0;

  bool point() const noexcept { return source_order == 0 && receiver_order == 0; }
};

/// Pairs of directions whose weighted mean of f is the reading f̄ of one sample:
///   f̄ = ∫∫ f cos θi dωi cos θo dωo / ∫∫ cos θi dωi cos θo dωo over both cones, cut at the horizon,
/// because a reading is divided by the projected solid angle of the receiver and by the irradiance of the source (measurement.md 1, 2).
/// Uniform radiance over the source and uniform sensitivity over the receiver are assumed.
struct AperturePair {
  Direction wi, wo;
  double weight = 0;  ///< all of them add up to 1
};
/// Empty if the cones lie below the horizon.
std::vector<AperturePair> aperture_pairs(const GonioAngles& angles, const ApertureRule& rule);
/// The same as geometries for a model; appends to both vectors and returns the number of nodes.
std::size_t aperture_nodes(const GonioAngles& angles, const ApertureRule& rule, std::vector<LobeGeometry>& geometry,
                           std::vector<double>& weight);

}  // namespace gonio
