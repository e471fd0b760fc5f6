// SPDX-License-Identifier: BSD-3-Clause
// Open Shading Language: a surface shader of the closures that OSL took over from MaterialX.
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets {
namespace {

enum Slot : std::size_t { albedo, f0, f90, alpha, aspect };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{
      {"albedo", 0, 1, true}, {"f0", 0, 1, true}, {"f90", 0, 1, true}, {"roughness", 1e-3, 1, false}, {"aspect", 0.1, 10, false, 1}};
  return list;
}

std::vector<double> convert(const LobeSummary& s, bool, std::size_t c) {
  return {s.rho_d[c], s.f0[c], s.f90[c], mean_width(s), aspect_of(s)};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), false, convert); }

std::string text(const Material& m) {
  const auto [ax, ay] = widths(m.shared(alpha), m.shared(aspect));
  return filled(
      R"({{comments}}// Colours are linear; f_r is the sum of the two closures. roughness_x and roughness_y are the GGX widths themselves.
surface gonio_material(
    color albedo = color({{albedo}}),
    color f0 = color({{f0}}),
    color f90 = color({{f90}}),
    float roughness_x = {{ax}},
    float roughness_y = {{ay}})
{
    vector along = normalize(dPdu);
    Ci = oren_nayar_diffuse_bsdf(N, albedo, 0.0)
       + generalized_schlick_bsdf(N, along, color(1.0), color(0.0), roughness_x, roughness_y, f0, f90, 5.0, "ggx");
}
)",
      {{"comments", commented(m.comments, "// ")},
       {"albedo", triple(m.colour(albedo), ", ")},
       {"f0", triple(m.colour(f0), ", ")},
       {"f90", triple(m.colour(f90), ", ")},
       {"ax", real(ax)},
       {"ay", real(ay)}});
}

}  // namespace

RenderTarget osl_target() {
  return {"osl",
          "Open Shading Language surface of MaterialX closures",
          ".osl",
          {{{"oren_nayar_diffuse_bsdf and generalized_schlick_bsdf",
             "OSL, src/shaders/stdosl.h; MaterialX physically based shading nodes",
             "roughness_x and roughness_y are the GGX widths themselves",
             "Smith, correlated through the height",
             "Schlick, F0 and F90 per channel, exponent 5",
             slots(),
             reference_formula().prepare,
             starts,
             {"one lobe and a Lambertian part: no second lobe, no retro-reflection"}},
            text}},
          {"closures are functions of the renderer: one that adds multiple scattering or separable shadowing differs from this formula"}};
}

}  // namespace gonio::tabulated::targets
