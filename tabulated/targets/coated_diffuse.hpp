// SPDX-License-Identifier: BSD-3-Clause
// A rough dielectric surface over a Lambertian base, with the light that is scattered between the two.
#pragma once

#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/rough_interface.hpp"
#include "tabulated/targets/starts.hpp"
#include "tabulated/targets/target.hpp"

/// f = scale F(n) D G/(4 cos θi cos θo) + the diffuse part of a RoughInterface.
namespace gonio::tabulated::targets::coated_diffuse {

enum Slot : std::size_t { albedo, alpha, index, scale };

/// Parameters under the names of a target; without a name the scale is no parameter, but 1.
std::vector<FormulaParameter> slots(std::string_view albedo_name, std::string_view alpha_name, std::string_view index_name,
                                    std::string_view scale_name);

template <RoughInterface::Shadowing shadowing, RoughInterface::Mean mean>
EvaluateFormula prepare(const ChannelValues& values) {
  const double a = values[0][alpha], n = values[0][index];
  const RoughInterface surface(a, n, shadowing, mean);
  return [values, a, n, surface](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double visibility =
        shadowing == RoughInterface::Shadowing::separable ? separable_visibility(wi, wo, a, a) : correlated_visibility(wi, wo, a, a);
    const double lobe = dielectric_fresnel(p.cos_d, n) * ggx_d(p, a, a) * visibility;
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = (values[c].size() > scale ? values[c][scale] : 1) * lobe + surface.diffuse(values[c][albedo], p.cos_i, p.cos_o);
  };
}

/// The values of one channel; the scale is left out by those who have none.
std::vector<double> converted(const LobeSummary& summary, std::size_t channel);

}  // namespace gonio::tabulated::targets::coated_diffuse
