// SPDX-License-Identifier: BSD-3-Clause
// A Lambertian and a rough conductor material, blended: the most flexible material of renderers without a single one for both.
#pragma once

#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/target.hpp"

/// f = (1 - weight) reflectance/π + weight F(eta, k) D G/(4 cos θi cos θo), F of a conductor per channel (of a dielectric where k = 0).
namespace gonio::tabulated::targets::conductor_mix {

enum Slot : std::size_t { reflectance, eta, k, alpha, aspect, weight };
const std::vector<FormulaParameter>& slots();
std::vector<ChannelValues> starts(const LobeSummary& summary);

using Visibility = double (*)(const Direction& wi, const Direction& wo, double ax, double ay);

template <Visibility visibility>
EvaluateFormula prepare(const ChannelValues& values) {
  const auto [ax, ay] = widths(values[0][alpha], values[0][aspect]);
  return [values, ax = ax, ay = ay, w = values[0][weight]](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double lobe = w * ggx_d(p, ax, ay) * visibility(wi, wo, ax, ay);
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = (1 - w) * values[c][reflectance] * inverse_pi + conductor_fresnel(p.cos_d, values[c][eta], values[c][k]) * lobe;
  };
}

}  // namespace gonio::tabulated::targets::conductor_mix
