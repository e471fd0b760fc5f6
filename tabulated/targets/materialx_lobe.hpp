// SPDX-License-Identifier: BSD-3-Clause
// The microfacet lobe of MaterialX's shading nodes, with its approximations of albedo and multiple scattering.
#pragma once

#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/target.hpp"

/// As the GLSL of MaterialX 1.39.5 computes it (libraries/pbrlib/genglsl). Trap: the shadowing of an anisotropic lobe is that of an
/// isotropic one of width √(αx αy), and the compensation knows the viewer only: the formula is not reciprocal.
namespace gonio::tabulated::targets::materialx {

/// Directional albedo of a lobe with Schlick's F: f0 · a + f90 · b.
struct AlbedoParts {
  double a, b;
};
/// MaterialX's rational fit to Monte Carlo data over the viewer's cosine and the width.
AlbedoParts lobe_albedo(double cos_o, double alpha);

/// What nodes take from a pair of directions: response = F · (1 + F · missing) · lobe [1/sr].
struct LobeAt {
  double lobe;         ///< D G/(4 cos θi cos θo)
  double missing;      ///< (1 - E)/E of the single-scattering albedo E of a mirror-like lobe
  AlbedoParts albedo;  ///< for what a dielectric leaves to the layer below

  double response(double fresnel) const { return fresnel * (1 + fresnel * missing) * lobe; }
  /// Share of light that passes a dielectric of this reflectance at the normal, where it reflects `fresnel` now, of this weight.
  double throughput(double f0, double fresnel, double weight) const {
    return 1 - (f0 * albedo.a + albedo.b) * (1 + fresnel * missing) * weight;
  }
};
LobeAt lobe_at(const MicrofacetPair& pair, const Widths& alpha);

}  // namespace gonio::tabulated::targets::materialx
