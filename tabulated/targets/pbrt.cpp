// SPDX-License-Identifier: BSD-3-Clause
// pbrt-v4: a scene with coateddiffuse, or with a mix of diffuse and conductor.
#include "tabulated/targets/coated_diffuse.hpp"
#include "tabulated/targets/conductor_mix.hpp"
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/sphere.hpp"

namespace gonio::tabulated::targets {
namespace {

namespace coated {

using namespace coated_diffuse;

const std::vector<FormulaParameter>& coated_slots() {
  static const std::vector<FormulaParameter> list = slots("reflectance", "roughness", "eta", "");
  return list;
}
std::vector<double> convert(const LobeSummary& s, bool, std::size_t c) { return converted(s, c); }
std::vector<ChannelValues> starts(const LobeSummary& s) {
  std::vector<ChannelValues> out = converted_starts(s, coated_slots(), false, convert);
  for (ChannelValues& values : out)
    for (auto& set : values) set.resize(coated_slots().size());
  return out;
}

std::string material(const Material& m) {
  return filled(R"(# roughness is the GGX width itself (no remapping); next to no thickness: nothing is absorbed between surface and base.
MakeNamedMaterial "material" "string type" "coateddiffuse"
    "bool remaproughness" false
    "float roughness" [ {{roughness}} ]
    "float eta" [ {{eta}} ]
    "float thickness" [ 1e-6 ]
    "integer maxdepth" [ 100 ]
    "rgb reflectance" [ {{reflectance}} ]
)",
                {{"roughness", real(m.shared(alpha))},
                 {"eta", real(m.shared(coated_diffuse::index))},
                 {"reflectance", triple(m.colour(albedo), " ")}});
}

}  // namespace coated

namespace blend {

using namespace conductor_mix;

std::string material(const Material& m) {
  const auto [ax, ay] = widths(m.shared(alpha), m.shared(aspect));
  return filled(R"(# roughness is the GGX width itself (no remapping); amount is the part of the conductor.
MakeNamedMaterial "base" "string type" "diffuse"
    "rgb reflectance" [ {{reflectance}} ]
MakeNamedMaterial "lobe" "string type" "conductor"
    "bool remaproughness" false
    "float uroughness" [ {{ax}} ]
    "float vroughness" [ {{ay}} ]
    "rgb eta" [ {{eta}} ]
    "rgb k" [ {{k}} ]
MakeNamedMaterial "material" "string type" "mix"
    "string materials" [ "base" "lobe" ]
    "float amount" [ {{amount}} ]
)",
                {{"reflectance", triple(m.colour(reflectance), " ")},
                 {"ax", real(ax)},
                 {"ay", real(ay)},
                 {"eta", triple(m.colour(eta), " ")},
                 {"k", triple(m.colour(k), " ")},
                 {"amount", real(m.shared(weight))}});
}

}  // namespace blend

template <std::string (*material)(const Material&)>
std::string scene(const Material& m) {
  return pbrt_sphere(commented(m.comments, "# "), material(m), "sphere.exr");
}

}  // namespace

RenderTarget pbrt_target() {
  return {"pbrt",
          "pbrt-v4 scene with one of its materials",
          ".pbrt",
          {{{"mix of diffuse and conductor",
             "pbrt-v4, src/pbrt/materials.h and bxdfs.h (MixMaterial, ConductorBxDF)",
             "uroughness and vroughness are the GGX widths themselves (remaproughness false; by default pbrt takes their square root)",
             "Smith, correlated through the height",
             "exact, of a conductor with eta and k per channel",
             conductor_mix::slots(),
             conductor_mix::prepare<correlated_visibility>,
             conductor_mix::starts,
             {"mix: the amounts of the diffuse and the mirror-like part add up to 1"}},
            scene<blend::material>},
           {{"coateddiffuse",
             "pbrt-v4, src/pbrt/bxdfs.h (LayeredBxDF of DielectricBxDF and DiffuseBxDF): the mean of its random walk",
             "roughness is the GGX width itself (remaproughness false; by default pbrt takes its square root)",
             "Smith, correlated through the height",
             "exact, of a dielectric; diffuse light is scattered between surface and base",
             coated::coated_slots(),
             coated_diffuse::prepare<RoughInterface::Shadowing::correlated, RoughInterface::Mean::trapezoidal>,
             coated::starts,
             {"coateddiffuse: isotropic, one index for all channels, a lobe without colour"}},
            scene<coated::material>}},
          {"pbrt renders spectra: it makes smooth spectra of the colours, of eta and k too, so that saturated ones shift a little"}};
}

}  // namespace gonio::tabulated::targets
