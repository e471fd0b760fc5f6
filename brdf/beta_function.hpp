// SPDX-License-Identifier: BSD-3-Clause
// The two special functions of the Phong albedo, accurate to a few rounding errors for every exponent up to 1e12.
#pragma once

namespace gonio {

/// Γ(z + 1/2) / Γ(z + 1) for z >= 0: asymptotic series at z >= 50, reached by upward recurrence.
double gamma_ratio_half(double z) noexcept;

/// The regularised incomplete beta function I_x(1/2, b) for 0 <= x <= 1, b >= 1, with `one_minus_x` given apart so that neither
/// end loses digits. Series with positive terms only (DLMF 8.17.8), from whichever end is nearer.
double incomplete_beta_half(double x, double one_minus_x, double b) noexcept;

}  // namespace gonio
