// SPDX-License-Identifier: BSD-3-Clause
// From the quantity a file holds to f.
#pragma once

#include "brdf/angle.hpp"
#include "brdf/channels.hpp"

namespace gonio::tabulated {

/// What a value has to be multiplied with to become f [1/sr]: 1 for f, 1/pi for a reflectance factor, 1/cos theta_o for f cos theta_o,
/// 1/(pi cos theta_o) for a signal relative to a white read at normal view. NaN where that cosine vanishes (below 1e-6).
double factor_to_f(Quantity quantity, Angle theta_o) noexcept;

}  // namespace gonio::tabulated
