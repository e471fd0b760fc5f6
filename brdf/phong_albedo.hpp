// SPDX-License-Identifier: BSD-3-Clause
// Directional albedo of the mirror-direction cosine lobe.
#pragma once

#include "brdf/angle.hpp"

namespace gonio {

/// A(s, theta) = (s+2)/(2π) ∫ cos^s ψ cos θo dωo over ψ < 90° above the horizon, for every real s >= 0:
///   A = cos θ [1/2 + 1/2 I_{cos² θ}(1/2, s/2+1)] + sin^{s+2} θ · Γ((s+1)/2) / (2 √π Γ(s/2+1)).
/// It solves F'' + F = √π Γ((s+3)/2)/Γ(s/2+2) sin^s θ, F = 2πA/(s+2), and generalises Arvo's integer-exponent moments
/// ("Applications of Irradiance Tensors", SIGGRAPH 1995). Falls from 1 at the normal to about 1/√(2πs) at grazing; s = 0 is the
/// limit s -> 0+, (1 + cos θ)/2.
double phong_albedo(double s, Angle theta) noexcept;

}  // namespace gonio
