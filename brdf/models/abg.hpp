// SPDX-License-Identifier: BSD-3-Clause
// The ABg model of stray-light programs.
#pragma once

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// f = ρd/π + A/(B + |β - β0|^g), β and β0 the outgoing and the mirror direction projected on the surface. The peak is A/B, the slope of
/// the log-log plot far from it -g, the shoulder at |β - β0| = B^{1/g}. Trap: usually without a diffuse part: fix rho_d = 0 to compare with
/// tables of A, B and g. On data that do not reach the shoulder only A and g are determined and B has an upper bound.
struct Abg {
  static constexpr std::string_view name = "abg";
  static constexpr std::string_view citation =
      "R. N. Pfisterer, Approximated Scatter Models for Stray Light Analysis, Optics & Photonics News 22(10), 2011";
  static constexpr std::array<Parameter, 4> parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.05},
                                                        {"a", "1/sr", 0, 1e9, true, 0, 0, Parameter::Axis::logarithmic, 0.02},
                                                        {"b", "1", 1e-15, 1e6, false, 1e-9, 10, Parameter::Axis::logarithmic, 0.01},
                                                        {"g", "1", 0.01, 20, false, 0.3, 6, Parameter::Axis::linear, 2}}};
  static constexpr PeakName peak{"a/b", "1/sr", 1};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using Real = Plain<T>;
    const T power = g.beta_gap > 0 ? decay<T>(nonlinear[1] * static_cast<Real>(-std::log(g.beta_gap))) : T(0);
    one_lobe_basis(Real(1) / (nonlinear[0] + power), out);
  }
};

}  // namespace gonio
