// SPDX-License-Identifier: BSD-3-Clause
// Disney's principled BRDF of 2012 as a .brdf file for BRDF Explorer and the viewers that read its files.
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets {
namespace {

enum Slot : std::size_t { base_color, metallic, subsurface, specular, roughness, anisotropic, sheen, clearcoat, clearcoat_gloss };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{
      {"baseColor", 0, 1, true}, {"metallic", 0, 1, false},     {"subsurface", 0, 1, false},
      {"specular", 0, 1, false}, {"roughness", 0.04, 1, false}, {"anisotropic", 0, 1, false, 0},
      {"sheen", 0, 1, false},    {"clearcoat", 0, 1, false},    {"clearcoatGloss", 0, 1, false}};
  return list;
}

constexpr double monitor_gamma = 2.2;  ///< of baseColor, as Disney's own file has it

double mix(double a, double b, double t) { return a + (b - a) * t; }

/// Smith's term over 2 cos θ for the clear coat's fixed width.
double coat_visibility(double cosine) { return 1 / (cosine + std::sqrt(0.0625 + 0.9375 * cosine * cosine)); }

/// The distribution with a long tail of the clear coat (Burley 2012, Eq. 4 with γ = 1).
double coat_distribution(double hz, double alpha) {
  const double a2 = alpha * alpha;
  return (a2 - 1) * inverse_pi / (std::log(a2) * (1 + (a2 - 1) * hz * hz));
}

EvaluateFormula prepare(const ChannelValues& values) {
  const std::vector<double>& s = values.front();
  const auto [ax, ay] = widths(s[roughness] * s[roughness], std::sqrt(1 - 0.9 * s[anisotropic]));
  std::vector<double> base;
  for (const auto& set : values) base.push_back(std::pow(set[base_color], monitor_gamma));
  return [s, base, ax = std::max(0.001, ax), ay = std::max(0.001, ay)](const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + base.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double fi = schlick_weight(p.cos_i), fo = schlick_weight(p.cos_o), fh = schlick_weight(p.cos_d);
    const double ss90 = p.cos_d * p.cos_d * s[roughness], ss = mix(1, ss90, fi) * mix(1, ss90, fo);
    const double flat = 1.25 * (ss * (1 / (p.cos_i + p.cos_o) - 0.5) + 0.5);
    const double diffuse = inverse_pi * mix(burley_diffuse(p, s[roughness]), flat, s[subsurface]);
    const double lobe = ggx_d(p, ax, ay) * separable_visibility(wi, wo, ax, ay);
    const double coat = 0.25 * s[clearcoat] * mix(0.04, 1, fh) * coat_distribution(p.hz, mix(0.1, 0.001, s[clearcoat_gloss])) *
                        coat_visibility(p.cos_i) * coat_visibility(p.cos_o);
    for (std::size_t c = 0; c < base.size(); ++c) {
      const double f0 = mix(0.08 * s[specular], base[c], s[metallic]);
      f[c] = (diffuse * base[c] + fh * s[sheen]) * (1 - s[metallic]) + mix(f0, 1, fh) * lobe + coat;
    }
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  return {std::pow(metal ? s.f0[c] : s.rho_d[c], 1 / monitor_gamma),
          metal ? 1.0 : 0.0,
          0,
          metal ? 0.5 : mean(s.f0) / 0.08,
          std::sqrt(mean_width(s)),
          burley_anisotropic(aspect_of(s)),
          0,
          0,
          1};
}

std::vector<ChannelValues> starts(const LobeSummary& s) {
  std::vector<ChannelValues> out = converted_starts(s, slots(), true, convert);
  // With a coat, which a start without one never sees: of no amount its gloss has no effect.
  for (std::size_t n = 2, k = 0; k < n; ++k) {
    ChannelValues coated = out[k];
    for (auto& set : coated) set[clearcoat] = 0.2, set[clearcoat_gloss] = 0.3;
    out.push_back(std::move(coated));
  }
  return out;
}

std::string text(const Material& m) {
  return filled(R"(analytic

# linear baseColor is the value here to the power of 2.2; roughness is the square root of the GGX width

::begin parameters
color baseColor {{baseColor}}
float metallic 0 1 {{metallic}}
float subsurface 0 1 {{subsurface}}
float specular 0 1 {{specular}}
float roughness 0 1 {{roughness}}
float anisotropic 0 1 {{anisotropic}}
float sheen 0 1 {{sheen}}
float clearcoat 0 1 {{clearcoat}}
float clearcoatGloss 0 1 {{clearcoatGloss}}
::end parameters

::begin shader

{{comments}}// f_r in 1/sr without cosine. L to the light, V to the viewer, X along the long axis of an anisotropic lobe.

const float pi = 3.14159265358979324;

float weight_at(float cosine)
{
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    return m * m * m * m * m;
}

float visibility_of(float z, float x, float y)
{
    return 1.0 / (z + sqrt(x * x + y * y + z * z));
}

float coat_visibility(float z)
{
    return 1.0 / (z + sqrt(0.0625 + 0.9375 * z * z));
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float li = dot(N, L);
    float vo = dot(N, V);
    if (li <= 0.0 || vo <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    float h = dot(N, H);
    float d = dot(L, H);
    float fl = weight_at(li);
    float fv = weight_at(vo);
    float fh = weight_at(d);
    vec3 base = vec3(pow(baseColor[0], 2.2), pow(baseColor[1], 2.2), pow(baseColor[2], 2.2));

    float d90 = 0.5 + 2.0 * roughness * d * d;
    float s90 = roughness * d * d;
    float flat_part = mix(1.0, s90, fl) * mix(1.0, s90, fv);
    flat_part = 1.25 * (flat_part * (1.0 / (li + vo) - 0.5) + 0.5);
    float diffuse = mix(mix(1.0, d90, fl) * mix(1.0, d90, fv), flat_part, subsurface) / pi;

    float aspect = sqrt(1.0 - 0.9 * anisotropic);
    float ax = max(0.001, roughness * roughness / aspect);
    float ay = max(0.001, roughness * roughness * aspect);
    float hx = dot(H, X) / ax;
    float hy = dot(H, Y) / ay;
    float q = hx * hx + hy * hy + h * h;
    float lobe = visibility_of(li, ax * dot(L, X), ay * dot(L, Y)) * visibility_of(vo, ax * dot(V, X), ay * dot(V, Y))
        / (pi * ax * ay * q * q);
    vec3 f0 = mix(vec3(0.08 * specular), base, metallic);
    vec3 fresnel = mix(f0, vec3(1.0), fh);

    float a = mix(0.1, 0.001, clearcoatGloss);
    float a2 = a * a;
    float coat = (a2 - 1.0) / (pi * log(a2) * (1.0 + (a2 - 1.0) * h * h));
    coat = 0.25 * clearcoat * mix(0.04, 1.0, fh) * coat * coat_visibility(li) * coat_visibility(vo);

    return (diffuse * base + vec3(fh * sheen)) * (1.0 - metallic) + lobe * fresnel + vec3(coat);
}

::end shader
)",
                {{"comments", commented(m.comments, "// ")},
                 {"baseColor", triple(m.colour(base_color), " ")},
                 {"metallic", real(m.shared(metallic))},
                 {"subsurface", real(m.shared(subsurface))},
                 {"specular", real(m.shared(specular))},
                 {"roughness", real(m.shared(roughness))},
                 {"anisotropic", real(m.shared(anisotropic))},
                 {"sheen", real(m.shared(sheen))},
                 {"clearcoat", real(m.shared(clearcoat))},
                 {"clearcoatGloss", real(m.shared(clearcoat_gloss))}});
}

}  // namespace

RenderTarget disney_target() {
  return {"disney",
          "Disney's principled BRDF of 2012 as a .brdf file (BRDF Explorer)",
          ".brdf",
          {{{"disney principled 2012",
             "B. Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course, with the code of BRDF Explorer's disney.brdf",
             "alpha = max(0.001, roughness²)",
             "Smith, product of both directions",
             "Schlick from 0.08 specular, or from the base colour of a metal, to 1",
             slots(),
             prepare,
             starts,
             {"one base colour is both the diffuse colour and the metal's reflectance; a dielectric reflects at most 0.08 at the normal",
              "the long axis of an anisotropic lobe is X"}},
            text}},
          {"specularTint and sheenTint are left out: they are 0 here"}};
}

}  // namespace gonio::tabulated::targets
