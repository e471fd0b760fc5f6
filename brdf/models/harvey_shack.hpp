// SPDX-License-Identifier: BSD-3-Clause
// The shift-invariant scatter of polished surfaces.
#pragma once

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// f = ρd/π + b0 (1 + (|β - β0|/l)²)^{s/2}, β and β0 the outgoing and the mirror direction projected on the surface; b0 [1/sr] the peak, l
/// the shoulder, s < 0 the slope of the log-log plot far from it. Trap: usually without a diffuse part: fix rho_d = 0 to compare with
/// tables. On data that do not reach the shoulder only b0 l^-s is determined.
struct HarveyShack {
  static constexpr std::string_view name = "harvey-shack";
  static constexpr std::string_view citation =
      "J. E. Harvey, Light-Scattering Characteristics of Optical Surfaces, PhD thesis, University of Arizona, 1976; three-parameter form "
      "as "
      "in R. N. Pfisterer, Approximated Scatter Models for Stray Light Analysis, Optics & Photonics News 22(10), 2011";
  static constexpr std::array<Parameter, 4> parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.05},
                                                        {"b0", "1/sr", 0, 1e9, true, 0, 0, Parameter::Axis::logarithmic, 2},
                                                        {"l", "1", 1e-7, 100, false, 1e-5, 1, Parameter::Axis::logarithmic, 0.1},
                                                        {"s", "1", -20, 0, false, -6, -0.3, Parameter::Axis::linear, -2}}};
  static constexpr PeakName peak{"b0", "1/sr", 1};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using std::log1p;
    using Real = Plain<T>;
    const T x = static_cast<Real>(g.beta_gap) / nonlinear[0];
    one_lobe_basis(decay<T>(Real(-0.5) * nonlinear[1] * log1p(x * x)), out);
  }
};

}  // namespace gonio
