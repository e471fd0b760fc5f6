// SPDX-License-Identifier: BSD-3-Clause
// How much light a rough dielectric surface lets through to a diffuse base, and sends back into it.
#pragma once

#include <array>
#include <cstddef>

namespace gonio::tabulated::targets {

/// A GGX surface of a dielectric over a Lambertian base of albedo a, without absorption between them. The light that reaches the base is
/// t(θi); of what the base sends up, r is reflected back by the surface, so that
///   f_diffuse = a t(θi) t(θo) / (π n² (1 - a r)).
/// t and r count single scattering at the surface, as renderers do: t(θ) = ∫ G(θ, θt)/G1(θ) (1 - F) over the normals seen from θ.
class RoughInterface {
 public:
  enum class Shadowing { separable, correlated };
  /// How r is taken from its 64 values over the cosine: Mitsuba's mean of all nodes, or the trapezoidal rule.
  enum class Mean { of_nodes, trapezoidal };

  RoughInterface(double alpha, double index, Shadowing shadowing, Mean mean);

  /// t, linear between 64 values over the cosine.
  double transmittance(double cosine) const;
  double internal_reflectance() const { return internal_; }
  /// f_diffuse [1/sr] of a base of this albedo.
  double diffuse(double albedo, double cos_i, double cos_o) const;

 private:
  static constexpr std::size_t nodes = 64;
  std::array<double, nodes> transmittance_;
  double internal_ = 0, inverse_index2_ = 1;
};

}  // namespace gonio::tabulated::targets
