// SPDX-License-Identifier: BSD-3-Clause
// MaterialX documents with one of the two surfaces most programs understand: standard_surface and open_pbr_surface.
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/materialx_lobe.hpp"
#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets {
namespace {

using materialx::LobeAt;

std::string document(const Material& m, std::string_view node, const std::string& inputs) {
  return filled(R"(<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <!--
{{comments}}  -->
  <{{node}} name="gonio_shader" type="surfaceshader">
{{inputs}}  </{{node}}>
  <surfacematerial name="gonio_material" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="gonio_shader" />
  </surfacematerial>
</materialx>
)",
                {{"comments", commented(m.comments, "    ")}, {"node", std::string(node)}, {"inputs", inputs}});
}

std::string input(std::string_view name, std::string_view type, const std::string& value) {
  return filled("    <input name=\"{{name}}\" type=\"{{type}}\" value=\"{{value}}\" />\n",
                {{"name", std::string(name)}, {"type", std::string(type)}, {"value", value}});
}

Widths turned(const Widths& w, double anisotropy) { return anisotropy < 0 ? Widths{w.y, w.x} : w; }

constexpr std::string_view shadowing =
    "Smith, correlated through the height, of an isotropic lobe of width √(αx αy); multiple scattering added";

// ---------------------------------------------------------------- standard_surface
namespace standard {

enum Slot : std::size_t { base_color, specular_color, metalness, roughness, ior, anisotropy };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{{"base_color", 0, 1, true},       {"specular_color", 0, 1, true},
                                                  {"metalness", 0, 1, false},       {"specular_roughness", 0.04, 1, false},
                                                  {"specular_IOR", 1.02, 4, false}, {"specular_anisotropy", -0.98, 0.98, false, 0}};
  return list;
}

/// Index and extinction from the colours at the normal and at the edge (O. Gulbrandsen, Artist Friendly Metallic Fresnel, JCGT 3(4), 2014).
struct ComplexIndex {
  double eta, k;
};
ComplexIndex artistic_index(double reflectivity, double edge) {
  const double r = std::clamp(reflectivity, 0.0, 0.99), root = std::sqrt(r);
  const double most = (1 + root) / (1 - root), eta = most + ((1 - r) / (1 + r) - most) * edge;
  return {eta, std::sqrt(std::max(0.0, ((eta + 1) * (eta + 1) * r - (eta - 1) * (eta - 1)) / (1 - r)))};
}

Widths lobe_widths(double rough, double amount) {
  const double a = rough * rough, aspect = std::sqrt(1 - std::abs(amount));
  return turned({std::min(a / aspect, 1.0), a * aspect}, amount);
}

EvaluateFormula prepare(const ChannelValues& values) {
  const std::vector<double>& s = values.front();
  std::vector<ComplexIndex> metal;
  for (const auto& v : values) metal.push_back(artistic_index(v[base_color], v[specular_color]));
  return [values, metal, alpha = lobe_widths(s[roughness], s[anisotropy]), n = s[ior], m = s[metalness]](const Direction& wi,
                                                                                                         const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const LobeAt lobe = materialx::lobe_at(p, alpha);
    const double fresnel = dielectric_fresnel(p.cos_d, n), through = lobe.throughput(f0_of(n), fresnel, 1), glossy = lobe.response(fresnel);
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = (1 - m) * (glossy * values[c][specular_color] + values[c][base_color] * inverse_pi * through) +
             m * lobe.response(conductor_fresnel(p.cos_d, metal[c].eta, metal[c].k));
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  return {metal ? s.f0[c] : s.rho_d[c],
          metal ? 0.5 : 1.0,
          metal ? 1.0 : 0.0,
          std::sqrt(mean_width(s)),
          metal ? 1.5 : index_of(mean(s.f0)),
          burley_anisotropic(aspect_of(s)) * 0.9};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), true, convert); }

std::string text(const Material& m) {
  const double amount = m.shared(anisotropy);
  return document(m, "standard_surface",
                  input("base", "float", "1.0") + input("base_color", "color3", triple(m.colour(base_color), ", ")) +
                      input("metalness", "float", real(m.shared(metalness))) + input("specular", "float", "1.0") +
                      input("specular_color", "color3", triple(m.colour(specular_color), ", ")) +
                      input("specular_roughness", "float", real(m.shared(roughness))) +
                      input("specular_IOR", "float", real(m.shared(ior))) + input("specular_anisotropy", "float", real(std::abs(amount))) +
                      input("specular_rotation", "float", amount < 0 ? "0.25" : "0.0"));
}

}  // namespace standard

// ---------------------------------------------------------------- open_pbr_surface
namespace open_pbr {

enum Slot : std::size_t { base_color, specular_color, metalness, roughness, ior, anisotropy };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{{"base_color", 0, 1, true},       {"specular_color", 0, 1, true},
                                                  {"base_metalness", 0, 1, false},  {"specular_roughness", 0.04, 1, false},
                                                  {"specular_ior", 1.02, 4, false}, {"specular_roughness_anisotropy", 0, 0.98, false, 0}};
  return list;
}

Widths lobe_widths(double rough, double amount) {
  const double across = 1 - amount, x = std::min(1.0, rough * rough * std::sqrt(2 / (across * across + 1)));
  return {x, std::min(1.0, across * x)};
}

/// Schlick's F from f0 to 1 with the reflectance near 82° tinted (N. Hoffman, Fresnel Equations Considered Harmful, MAM 2019).
double tinted_fresnel(double c, double f0, double tint) {
  constexpr double at = 1.0 / 7;
  const double left = 1 - at, left5 = left * left * left * left * left, m = 1 - c, w = schlick_weight(c);
  const double amount = (f0 + (1 - f0) * left5) * (1 - tint) / (at * left5 * left);
  return f0 + (1 - f0) * w - amount * c * w * m;
}

EvaluateFormula prepare(const ChannelValues& values) {
  const std::vector<double>& s = values.front();
  return [values, alpha = lobe_widths(s[roughness], s[anisotropy]), n = s[ior], m = s[metalness]](const Direction& wi, const Direction& wo,
                                                                                                  double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const LobeAt lobe = materialx::lobe_at(p, alpha);
    const double fresnel = dielectric_fresnel(p.cos_d, n), through = lobe.throughput(f0_of(n), fresnel, 1), glossy = lobe.response(fresnel);
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = (1 - m) * (glossy * values[c][specular_color] + values[c][base_color] * inverse_pi * through) +
             m * lobe.response(std::max(0.0, tinted_fresnel(p.cos_d, values[c][base_color], values[c][specular_color])));
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  const double ratio = std::min(1.0, s.alpha_y / s.alpha_x), a2 = (s.alpha_x * s.alpha_x + s.alpha_y * s.alpha_y) / 2;
  return {metal ? s.f0[c] : s.rho_d[c], 1.0, metal ? 1.0 : 0.0, std::sqrt(std::sqrt(a2)), metal ? 1.5 : index_of(mean(s.f0)), 1 - ratio};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), true, convert); }

std::string text(const Material& m) {
  return document(m, "open_pbr_surface",
                  input("base_weight", "float", "1.0") + input("base_color", "color3", triple(m.colour(base_color), ", ")) +
                      input("base_metalness", "float", real(m.shared(metalness))) + input("specular_weight", "float", "1.0") +
                      input("specular_color", "color3", triple(m.colour(specular_color), ", ")) +
                      input("specular_roughness", "float", real(m.shared(roughness))) +
                      input("specular_ior", "float", real(m.shared(ior))) +
                      input("specular_roughness_anisotropy", "float", real(m.shared(anisotropy))));
}

}  // namespace open_pbr

constexpr std::string_view one_colour =
    "base_color is both the diffuse colour and the metal's reflectance, specular_color both the tint of a dielectric and the metal's edge";
constexpr std::string_view versions =
    "the formula is that of MaterialX 1.39.5's GLSL; other programs compensate multiple scattering in their own ways";

}  // namespace

RenderTarget standard_surface_target() {
  return {"materialx-standard-surface",
          "MaterialX document with a standard_surface",
          ".mtlx",
          {{{"standard_surface",
             "MaterialX 1.39.5, libraries/bxdf/standard_surface.mtlx and libraries/pbrlib/genglsl",
             "alpha = specular_roughness²; αx = alpha/√(1 - |anisotropy|), αy = alpha √(1 - |anisotropy|)",
             shadowing,
             "exact: of a dielectric of specular_IOR, of a conductor made from base_color and specular_color (artistic_ior)",
             standard::slots(),
             standard::prepare,
             standard::starts,
             {one_colour}},
            standard::text}},
          {versions}};
}

RenderTarget open_pbr_target() {
  return {"openpbr",
          "MaterialX document with an open_pbr_surface",
          ".mtlx",
          {{{"open_pbr_surface",
             "MaterialX 1.39.5, libraries/bxdf/open_pbr_surface.mtlx and libraries/pbrlib/genglsl",
             "αx = specular_roughness² √(2/(1 + (1 - anisotropy)²)), αy = (1 - anisotropy) αx",
             shadowing,
             "exact for the dielectric of specular_ior; for the metal Schlick with a tint at 82 degrees",
             open_pbr::slots(),
             open_pbr::prepare,
             open_pbr::starts,
             {one_colour, "the long axis of an anisotropic lobe is the tangent"}},
            open_pbr::text}},
          {versions}};
}

}  // namespace gonio::tabulated::targets
