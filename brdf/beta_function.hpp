// SPDX-License-Identifier: BSD-3-Clause
// The two special functions of the Phong albedo, accurate to a few rounding errors for every exponent up to 1e12.
#pragma once

#include <cmath>
#include <type_traits>

namespace gonio {

/// Γ(z + 1/2) / Γ(z + 1) for z >= 0 in float, double or long double: asymptotic series at z >= 50 (1e-15; 400 in long double, 1e-20),
/// reached by upward recurrence. The difference of two lgamma loses 4e-10 at z = 5e5 and tgamma overflows at 170.
template <class T>
T gamma_ratio_half(T z) noexcept {
  // Γ(z+1/2)/Γ(z+1) = Γ(z+3/2)/Γ(z+2) · (z+1)/(z+1/2)
  constexpr T far_enough = std::is_same_v<T, long double> ? T(400) : T(50);
  T factor = 1;
  for (; z < far_enough; z += 1) factor *= (z + 1) / (z + T(0.5));
  const T w = 1 / z;
  const T series =
      1 + w * (T(-1.0 / 8) +
               w * (T(1.0 / 128) + w * (T(5.0 / 1024) + w * (T(-21.0 / 32768) + w * (T(-399.0 / 262144) + w * T(869.0 / 4194304))))));
  return factor * series / std::sqrt(z);
}

/// The regularised incomplete beta function I_x(1/2, b) for 0 <= x <= 1, b >= 1, with `one_minus_x` given apart so that neither
/// end loses digits. Series with positive terms only (DLMF 8.17.8), from whichever end is nearer.
double incomplete_beta_half(double x, double one_minus_x, double b) noexcept;

}  // namespace gonio
