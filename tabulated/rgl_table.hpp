// SPDX-License-Identifier: BSD-3-Clause
// A BRDF in the adaptive parameterisation of the RGL material database.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"
#include "tabulated/large_array.hpp"
#include "tabulated/marginal_warp.hpp"
#include "tabulated/rgl_coordinates.hpp"

namespace gonio::tabulated {

/// The arrays of a file, C order. The unit square of directions is u.x = sqrt(2 theta / pi), u.y = (phi + pi) / (2 pi).
struct RglArrays {
  std::vector<float> phi_i, theta_i;              ///< [P], [T] incidences of the slices, radians, increasing
  std::size_t angle_rows = 0, angle_columns = 0;  ///< grid of `ndf` and `sigma` over u: phi, theta
  std::vector<float> ndf;                         ///< density of half vectors per solid angle
  std::vector<float> sigma;                       ///< projected area of what is seen from a direction, > 0
  std::size_t vndf_rows = 0, vndf_columns = 0;
  std::vector<float> vndf;  ///< [P, T, rows, columns] density of visible half vectors over u, any scale
  std::size_t value_rows = 0, value_columns = 0;
  std::vector<float> values;     ///< [P, T, channel, rows, columns] f cos theta_o · 4 sigma(wi) / ndf(m) over the warped square
  std::vector<float> luminance;  ///< [P, T, rows, columns] >= 0: where renderers put their samples; of no meaning to values
  Channels channels;
  std::string description;
};

/// Dupuy and Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", ACM TOG 37(6), 2018:
///   f cos theta_o = S(s) ndf(m) / (4 sigma(wi)),  s = the point the half vector m is sent to by the map that makes `vndf` uniform.
/// With at most two phi_i the half vector's azimuth is taken relative to the incidence.
///
/// `eval` divides by cos theta_o: 1/sr, **cosine not included**, unlike the readers that come with the database. Values are given as they
/// are stored, negative ones included (colours outside the gamut); beyond the last theta_i the last slice holds. The parameterisation is
/// conditioned on wi: nothing makes such a table reciprocal, and measured ones are not.
class RglTable final : public Brdf {
 public:
  /// How often the phi_i of an anisotropic table go into a full turn: 1, 2 (half the circle, the rest by rotation), 4 (a quadrant, the rest
  /// by mirror images); 0 if into none. Isotropic tables: 1.
  static int turns(const std::vector<float>& phi_i) noexcept;
  static bool is_isotropic(const std::vector<float>& phi_i) noexcept { return phi_i.size() <= 2; }

  /// Trusts that the arrays fit together.
  explicit RglTable(RglArrays arrays);

  /// What it was made from.
  RglArrays arrays() const;

  const Channels& channels() const override { return arrays_.channels; }
  Symmetry symmetry() const override { return {.isotropic = arrays_.phi_i.size() == 1, .bilateral = false, .reciprocal = false}; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

  /// Directions nearer to the horizon than this have no sample: f is a ratio of two vanishing numbers there.
  static constexpr double least_cosine = 0.0175;  // 1 degree
  /// The nodes of the table as samples. Nodes below the horizon and slices at grazing incidence (which the database fills with copies
  /// of the one before) are counted as below the horizon, nodes whose channels are all exactly 0 (never measured) as missing.
  Dataset samples() const;

 private:
  /// Writes the values of every pair to the channels at `place(k)`.
  template <class Place>
  void look_up(RglPairs& pairs, Place&& place) const;
  void find_slices(double theta_i, double phi_i, SliceWeights& out) const noexcept;
  void find_factors(const RglPairs& pairs, SquareColumn& out) const noexcept;
  UnitPoint unit_point(double theta, double phi) const noexcept;

  RglArrays arrays_;  ///< but for vndf and values
  MarginalWarp vndf_;
  LargeArray<float> values_;  ///< [P, T, row, column, channel]: the channels of a node together
  int turns_;
};

}  // namespace gonio::tabulated
