// SPDX-License-Identifier: BSD-3-Clause
// A, B and g of the ABg model from values of a BRDF.
#pragma once

#include <cstddef>
#include <span>

namespace gonio::tabulated {

/// f = A / (B + x^g) with x = |β - β0|, β and β0 the outgoing and the specular direction projected on the surface.
struct AbgParameters {
  double a = 0, b = 0, g = 0;

  /// f [1/sr] at x >= 0.
  double at(double x) const noexcept;
};

constexpr std::ptrdiff_t least_abg_samples = 4;

struct AbgFit {
  AbgParameters parameters;
  double rms_log = 0;  ///< root mean square of ln f - ln of the model
};

/// Least squares on ln f by damped Gauss-Newton steps in ln A, ln B and g from 20 starts, within 1e-12 <= B <= 1e6 and 0 <= g <= 20 (B
/// below 1e-12 is refused by OpticStudio). `x` and `f` are of equal length; f that are not positive, or NaN, are left out. Throws
/// Error(input) if fewer than `least_abg_samples` are left.
AbgFit fit_abg(std::span<const double> x, std::span<const double> f);

}  // namespace gonio::tabulated
