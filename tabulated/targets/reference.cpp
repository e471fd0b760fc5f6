// SPDX-License-Identifier: BSD-3-Clause
// The formula that summaries are read from: Lambert and an anisotropic GGX lobe with Schlick's Fresnel reflectance.
#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/starts.hpp"
#include "tabulated/targets/target.hpp"

namespace gonio::tabulated::targets {
namespace {

enum Slot : std::size_t { rho_d, f0, f90, alpha, aspect };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{
      {"rho_d", 0, 10, true}, {"f0", 0, 10, true}, {"f90", 0, 10, true}, {"alpha", 1e-3, 2, false}, {"aspect", 0.1, 10, false, 1}};
  return list;
}

EvaluateFormula prepare(const ChannelValues& values) {
  const auto [ax, ay] = widths(values[0][alpha], values[0][aspect]);
  return [values, ax = ax, ay = ay](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double lobe = ggx_d(p, ax, ay) * correlated_visibility(wi, wo, ax, ay), w = schlick_weight(p.cos_d);
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = values[c][rho_d] * inverse_pi + (values[c][f0] * (1 - w) + values[c][f90] * w) * lobe;
  };
}

std::vector<double> convert(const LobeSummary& s, bool, std::size_t c) {
  return {s.rho_d[c], s.f0[c], s.f90[c], mean_width(s), aspect_of(s)};
}

std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), false, convert); }

}  // namespace

const TargetFormula& reference_formula() {
  static const TargetFormula formula{
      "ggx",
      "B. Walter et al., EGSR 2007; E. Heitz, JCGT 3(2), 2014, Eq. 99; C. Schlick, CGF 13(3), 1994; B. Burley, SIGGRAPH 2012 course",
      "alpha_x and alpha_y are the GGX widths themselves",
      "Smith, correlated through the height",
      "Schlick, F0 and F90 per channel",
      slots(),
      prepare,
      starts,
      {"one lobe and a Lambertian part: no second lobe, no retro-reflection"}};
  return formula;
}

LobeSummary reference_summary(const ChannelValues& values) {
  LobeSummary out;
  for (const auto& set : values) out.rho_d.push_back(set[rho_d]), out.f0.push_back(set[f0]), out.f90.push_back(set[f90]);
  const auto [x, y] = widths(values[0][alpha], values[0][aspect]);
  out.alpha_x = x, out.alpha_y = y;
  return out;
}

}  // namespace gonio::tabulated::targets
