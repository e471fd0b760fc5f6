// SPDX-License-Identifier: BSD-3-Clause
// Mitsuba 3: a scene in XML with one of its plugins roughplastic, blendbsdf of diffuse and roughconductor, or principled.
#include "tabulated/targets/coated_diffuse.hpp"
#include "tabulated/targets/conductor_mix.hpp"
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/sphere.hpp"

namespace gonio::tabulated::targets {
namespace {

// ---------------------------------------------------------------- roughplastic
namespace plastic {

using namespace coated_diffuse;

const std::vector<FormulaParameter>& plastic_slots() {
  static const std::vector<FormulaParameter> list = slots("diffuse_reflectance", "alpha", "int_ior", "specular_reflectance");
  return list;
}
std::vector<double> convert(const LobeSummary& s, bool, std::size_t c) { return converted(s, c); }
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, plastic_slots(), false, convert); }

std::string bsdf(const Material& m) {
  return filled(R"(    <bsdf type="roughplastic" id="material">
        <!-- alpha: the GGX width itself. nonlinear: light is also scattered between base and surface. -->
        <string name="distribution" value="ggx"/>
        <boolean name="nonlinear" value="true"/>
        <float name="alpha" value="{{alpha}}"/>
        <float name="int_ior" value="{{int_ior}}"/>
        <float name="ext_ior" value="1.0"/>
        <rgb name="diffuse_reflectance" value="{{diffuse}}"/>
        <rgb name="specular_reflectance" value="{{specular}}"/>
    </bsdf>
)",
                {{"alpha", real(m.shared(alpha))},
                 {"int_ior", real(m.shared(coated_diffuse::index))},
                 {"diffuse", triple(m.colour(albedo), ", ")},
                 {"specular", triple(m.colour(scale), ", ")}});
}

}  // namespace plastic

// ---------------------------------------------------------------- blendbsdf of diffuse and roughconductor
namespace blend {

using namespace conductor_mix;

std::string bsdf(const Material& m) {
  const auto [ax, ay] = widths(m.shared(alpha), m.shared(aspect));
  return filled(R"(    <bsdf type="blendbsdf" id="material">
        <!-- weight: the part of the second material. -->
        <float name="weight" value="{{weight}}"/>
        <bsdf type="diffuse">
            <rgb name="reflectance" value="{{reflectance}}"/>
        </bsdf>
        <bsdf type="roughconductor">
            <!-- alpha: the GGX widths themselves along u and v. -->
            <string name="distribution" value="ggx"/>
            <float name="alpha_u" value="{{alpha_u}}"/>
            <float name="alpha_v" value="{{alpha_v}}"/>
            <rgb name="eta" value="{{eta}}"/>
            <rgb name="k" value="{{k}}"/>
        </bsdf>
    </bsdf>
)",
                {{"weight", real(m.shared(weight))},
                 {"reflectance", triple(m.colour(reflectance), ", ")},
                 {"alpha_u", real(ax)},
                 {"alpha_v", real(ay)},
                 {"eta", triple(m.colour(eta), ", ")},
                 {"k", triple(m.colour(k), ", ")}});
}

}  // namespace blend

// ---------------------------------------------------------------- principled
namespace principled {

enum Slot : std::size_t { base_color, roughness, metallic, eta, anisotropic };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{{"base_color", 0, 1, true},
                                                  {"roughness", 0.04, 1, false},
                                                  {"metallic", 0, 1, false},
                                                  {"eta", 1.02, 4, false},
                                                  {"anisotropic", 0, 1, false, 0}};
  return list;
}

EvaluateFormula prepare(const ChannelValues& values) {
  const double r = values[0][roughness], m = values[0][metallic], n = values[0][eta];
  const auto [ax, ay] = widths(r * r, std::sqrt(1 - 0.9 * values[0][anisotropic]));
  return [values, r, m, n, ax = std::max(0.001, ax), ay = std::max(0.001, ay)](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double lobe = ggx_d(p, ax, ay) * separable_visibility(wi, wo, ax, ay), w = schlick_weight(p.cos_d);
    const double dielectric = (1 - m) * dielectric_fresnel(p.cos_d, n), diffuse = (1 - m) * inverse_pi * burley_diffuse(p, r);
    for (std::size_t c = 0; c < values.size(); ++c) {
      const double base = values[c][base_color];
      f[c] = diffuse * base + (dielectric + m * (base + (1 - base) * w)) * lobe;
    }
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  const double n = metal ? 1.5 : index_of(mean(s.f0));
  return {metal ? s.f0[c] : s.rho_d[c], std::sqrt(mean_width(s)), metal ? 1.0 : 0.0, n, burley_anisotropic(aspect_of(s))};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), true, convert); }

std::string bsdf(const Material& m) {
  return filled(R"(    <bsdf type="principled" id="material">
        <!-- roughness: the square root of the GGX width. -->
        <rgb name="base_color" value="{{base_color}}"/>
        <float name="roughness" value="{{roughness}}"/>
        <float name="metallic" value="{{metallic}}"/>
        <float name="eta" value="{{eta}}"/>
        <float name="anisotropic" value="{{anisotropic}}"/>
    </bsdf>
)",
                {{"base_color", triple(m.colour(base_color), ", ")},
                 {"roughness", real(m.shared(roughness))},
                 {"metallic", real(m.shared(metallic))},
                 {"eta", real(m.shared(eta))},
                 {"anisotropic", real(m.shared(anisotropic))}});
}

}  // namespace principled

template <std::string (*bsdf)(const Material&)>
std::string scene(const Material& m) {
  return mitsuba_sphere(commented(m.comments, "  "), bsdf(m));
}

}  // namespace

RenderTarget mitsuba_target() {
  return {"mitsuba",
          "Mitsuba 3 scene with one of its materials",
          ".xml",
          {{{"blendbsdf of diffuse and roughconductor",
             "Mitsuba 3, src/bsdfs/blendbsdf.cpp, diffuse.cpp, roughconductor.cpp",
             "alpha_u and alpha_v are the GGX widths themselves",
             "Smith, product of both directions",
             "exact, of a conductor with eta and k per channel",
             conductor_mix::slots(),
             conductor_mix::prepare<separable_visibility>,
             conductor_mix::starts,
             {"blendbsdf: the amounts of the diffuse and the mirror-like part add up to 1"}},
            scene<blend::bsdf>},
           {{"roughplastic",
             "Mitsuba 3, src/bsdfs/roughplastic.cpp",
             "alpha is the GGX width itself",
             "Smith, product of both directions",
             "exact, of a dielectric; diffuse light passes the surface twice and is scattered between (nonlinear)",
             plastic::plastic_slots(),
             coated_diffuse::prepare<RoughInterface::Shadowing::separable, RoughInterface::Mean::of_nodes>,
             plastic::starts,
             {"roughplastic: isotropic, one index for all channels"}},
            scene<plastic::bsdf>},
           {{"principled",
             "Mitsuba 3, src/bsdfs/principled.cpp",
             "alpha = max(0.001, roughness²)",
             "Smith, product of both directions",
             "exact for the dielectric, Schlick from the base colour to 1 for the metal",
             principled::slots(),
             principled::prepare,
             principled::starts,
             {"principled: one base colour is both the diffuse colour and the metal's reflectance",
              "principled: the long axis of an anisotropic lobe is u"}},
            scene<principled::bsdf>}},
          {"colours are linear sRGB; in a spectral variant Mitsuba makes smooth spectra of them, of eta and k too"}};
}

}  // namespace gonio::tabulated::targets
