// SPDX-License-Identifier: BSD-3-Clause
// What the two ABC models of Low et al. share.
#pragma once

#include "brdf/models/microfacet.hpp"

namespace gonio {

inline constexpr std::array<Parameter, 2> abc_linear_parameters{{{"rho_d", "1", 0, 1e6, true, 0, 0, Parameter::Axis::logarithmic, 0.1},
                                                                 {"a", "1/sr", 0, 1e9, true, 0, 0, Parameter::Axis::logarithmic, 30}}};
/// The index hardly changes the shape of the lobe before grazing, elsewhere A takes up what it does: a fit holds it.
inline constexpr std::array<Parameter, 3> abc_nonlinear_parameters{
    {{"b", "1", 1e-3, 1e9, false, 1, 1e7, Parameter::Axis::logarithmic, 100},
     {"c", "1", 1e-2, 100, false, 0.05, 10, Parameter::Axis::logarithmic, 1.2},
     {"n", "1", 1.001, 100, false, 1.05, 10, Parameter::Axis::logarithmic, 1.5, true}}};

/// (1 + B x)^-C, with B and C the first two nonlinear parameters.
template <class T>
T abc_falloff(double x, const T* nonlinear) {
  using std::log1p;
  using Real = Plain<T>;
  return decay<T>(nonlinear[1] * log1p(nonlinear[0] * static_cast<Real>(x)));
}

}  // namespace gonio
