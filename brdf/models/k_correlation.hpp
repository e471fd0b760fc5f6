// SPDX-License-Identifier: BSD-3-Clause
// Scatter of a polished surface whose roughness has the K-correlation spectrum.
#pragma once

#include "brdf/models/microfacet.hpp"

namespace gonio {

/// f = ρd/π + A cos θi cos θo/(1 + (B |β - β0|)²)^{(C + 1)/2}: Rayleigh-Rice scatter, 16π²/λ⁴ cos θi cos θo Q S(f), of the two-dimensional
/// spectrum S = A'/(1 + (B' f)²)^{(C + 1)/2} at f = |β - β0|/λ, its polarisation factor Q taken as constant. A = 16π² Q A'/λ⁴ [1/sr] is the
/// peak at the normal, B = B'/λ the correlation length in wavelengths times 2π, C + 1 the slope far from the shoulder |β - β0| = 1/B. Trap:
/// usually without a diffuse part: fix rho_d = 0 to compare with tables. Valid for roughness far below the wavelength.
struct KCorrelation {
  static constexpr std::string_view name = "k-correlation";
  static constexpr std::string_view citation =
      "J. C. Stover, Optical Scattering: Measurement and Analysis, 3rd ed., SPIE Press, 2012; M. G. Dittman, K-correlation power spectral "
      "density and surface scatter model, Proc. SPIE 6291, 2006";
  static constexpr std::array<Parameter, 4> parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.05},
                                                        {"a", "1/sr", 0, 1e9, true, 0, 0, Parameter::Axis::logarithmic, 2},
                                                        {"b", "1", 1e-3, 1e7, false, 1, 1e5, Parameter::Axis::logarithmic, 10},
                                                        {"c", "1", 0, 20, false, 0.2, 5, Parameter::Axis::linear, 1.5}}};
  static constexpr PeakName peak{"a", "1/sr", 1};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    using std::log1p;
    using Real = Plain<T>;
    const T x = nonlinear[0] * static_cast<Real>(g.beta_gap);
    const T falloff = decay<T>(Real(0.5) * (nonlinear[1] + Real(1)) * log1p(x * x));
    one_lobe_basis(falloff * static_cast<Real>(g.cos_i * g.cos_o), out);
  }
};

}  // namespace gonio
