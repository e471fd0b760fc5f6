// SPDX-License-Identifier: BSD-3-Clause
// Directions drawn where a BRDF sends its light, for any table or model.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "brdf/brdf.hpp"

namespace gonio::tabulated {

/// How finely the density is tabulated.
struct SamplerGrid {
  std::size_t theta_i = 16;  ///< incidences from 0 to 90°, denser towards grazing
  std::size_t phi_i = 1;     ///< incident azimuths round the circle; 1 for an isotropic BRDF
  std::size_t theta_h = 48;  ///< rings of half vectors, edges at (k/n)² 90°
  std::size_t phi_h = 32;    ///< sectors of each ring, from the incident azimuth on (isotropic) or from +x
};

/// A direction that was drawn, and the density of drawing it [1/sr]; 0 if it lies below the horizon: such a sample carries nothing.
struct DirectionSample {
  Direction wo;
  double pdf = 0;
};

/// Draws outgoing directions with a density near f cos theta_o in luminance, given wi. Cells of half vectors are chosen by their share, and
/// a half vector uniformly in solid angle within its cell, so the density is a step function of the half vector,
///   pdf(wo) = (1 - w) P_cell / (Omega_cell 4 wi·h) + w cos theta_o / pi,      h = (wi + wo)/|wi + wo|,
/// known exactly (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, eq. 14, for the Jacobian). w is the
/// share of directions drawn by the cosine alone: it bounds f cos / pdf wherever f is bounded, also where the table of cells has missed
/// something. Between the tabulated incidences one neighbour is chosen by its weight, and the density is their mean.
///
/// What is negative or unknown counts as dark. Safe to use from several threads.
class ImportanceSampler {
 public:
  static constexpr double cosine_share = 0.1;

  ImportanceSampler(std::shared_ptr<const Brdf> brdf, SamplerGrid grid, int threads);

  /// `uniform` in [0, 1)². wi must lie above the horizon.
  DirectionSample sample(const Direction& wi, std::array<double, 2> uniform) const;
  /// The density of `sample` giving wo [1/sr]; 0 where either direction is below the horizon.
  double pdf(const Direction& wi, const Direction& wo) const;

 private:
  struct Neighbours;
  Neighbours neighbours(const Direction& wi) const;
  std::size_t cells_per_slice() const noexcept { return grid_.theta_h * grid_.phi_h; }
  void fill(std::size_t slice);

  std::shared_ptr<const Brdf> brdf_;
  SamplerGrid grid_;
  std::vector<double> theta_i_;     ///< of the slices, radians
  std::vector<double> cumulative_;  ///< [slice][cell] share of this and all earlier cells; the last is 1
};

}  // namespace gonio::tabulated
