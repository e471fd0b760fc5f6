// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/ward_lobe.hpp"

#include "tabulated/targets/microfacet.hpp"

namespace gonio::tabulated::targets::ward_lobe {

std::vector<FormulaParameter> slots(double most) {
  return {{"rho_d", 0, most, true}, {"rho_s", 0, most, true}, {"alpha", 1e-3, 2, false}, {"aspect", 0.1, 10, false, 1}};
}

EvaluateFormula prepare(const ChannelValues& values) {
  const auto [ax, ay] = widths(values[0][alpha], values[0][aspect]);
  return [values, ax = ax, ay = ay](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const double x = wi.x() + wo.x(), y = wi.y() + wo.y(), z = wi.z() + wo.z(), sx = x / (z * ax), sy = y / (z * ay);
    const double lobe = decay(sx * sx + sy * sy) * inverse_pi / (ax * ay) * (x * x + y * y + z * z) / (z * z * z * z);
    for (std::size_t c = 0; c < values.size(); ++c) f[c] = values[c][rho_d] * inverse_pi + values[c][rho_s] * lobe;
  };
}

}  // namespace gonio::tabulated::targets::ward_lobe
