// SPDX-License-Identifier: BSD-3-Clause
// Blender 3.4: a Python program that builds the Principled BSDF on a sphere with light and camera.
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets {
namespace {

enum Slot : std::size_t { base_color, metallic, specular, roughness, anisotropic };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{{"Base Color", 0, 1, true},
                                                  {"Metallic", 0, 1, false},
                                                  {"Specular", 1e-3, 1, false},
                                                  {"Roughness", 0.04, 1, false},
                                                  {"Anisotropic", -1, 1, false, 0}};
  return list;
}

/// Negative where the lobe is longer along y: the tangent is turned by a quarter.
Widths lobe_widths(double rough, double amount) {
  const auto [along, across] = widths(rough * rough, std::sqrt(1 - 0.9 * std::abs(amount)));
  const double a = std::min(1.0, along), b = std::min(1.0, across);
  return amount < 0 ? Widths{b, a} : Widths{a, b};
}

EvaluateFormula prepare(const ChannelValues& values) {
  const std::vector<double>& s = values.front();
  const auto [ax, ay] = lobe_widths(s[roughness], s[anisotropic]);
  const double f0 = 0.08 * s[specular];
  return [values, ax = ax, ay = ay, f0, n = index_of(f0), r = s[roughness], m = s[metallic]](const Direction& wi, const Direction& wo,
                                                                                             double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double lobe = ggx_d(p, ax, ay) * separable_visibility(wi, wo, ax, ay);
    // How far Fresnel's reflectance has gone from that at the normal to 1.
    const double rise = (dielectric_fresnel(p.cos_d, n) - f0) / (1 - f0), diffuse = (1 - m) * inverse_pi * burley_diffuse(p, r);
    for (std::size_t c = 0; c < values.size(); ++c) {
      const double base = values[c][base_color], normal = (1 - m) * f0 + m * base;
      f[c] = diffuse * base + (normal + (1 - normal) * rise) * lobe;
    }
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  return {metal ? s.f0[c] : s.rho_d[c], metal ? 1.0 : 0.0, metal ? 0.5 : mean(s.f0) / 0.08, std::sqrt(mean_width(s)),
          burley_anisotropic(aspect_of(s))};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), true, convert); }

std::string text(const Material& m) {
  return filled(R"({{comments}}# Colours are linear sRGB; Roughness is the square root of the GGX width. For Blender 3.4 and Cycles.
# Picture:  blender -b -P THIS_FILE -- --render sphere.png [--samples 64] [--size 256]
# In another program of yours: exec this file's material() and take what it returns.
import sys

import bpy

VALUES = {
    "Base Color": ({{base}}, 1.0),
    "Metallic": {{metallic}},
    "Specular": {{specular}},
    "Roughness": {{roughness}},
    "Anisotropic": {{anisotropic}},
    "Anisotropic Rotation": {{rotation}},
}


def material(name="gonio material"):
    """A material of one Principled BSDF with these values."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    node = made.node_tree.nodes["Principled BSDF"]
    node.distribution = "GGX"
    for slot, value in VALUES.items():
        node.inputs[slot].default_value = value
    return made


def scene():
    """A sphere of it under a sun and a weak sky, seen by a camera."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=1.0)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(material())
    here = bpy.context.scene
    here.world = bpy.data.worlds.new("sky")
    here.world.use_nodes = True
    here.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.1, 0.1, 0.1, 1.0)
    bpy.ops.object.light_add(type="SUN", rotation=(0.8, 0.0, -0.5))
    bpy.context.object.data.energy = 3.0
    bpy.context.object.data.angle = 0.0
    bpy.ops.object.camera_add(location=(0.0, -5.0, 0.0), rotation=(1.5707963267948966, 0.0, 0.0))
    here.camera = bpy.context.object
    here.camera.data.angle = 0.5235987755982988
    here.render.engine = "CYCLES"
    here.cycles.use_denoising = False
    here.view_settings.view_transform = "Standard"
    return here


def argument(name, otherwise):
    after = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return after[after.index(name) + 1] if name in after else otherwise


if __name__ == "__main__":
    here = scene()
    here.cycles.samples = int(argument("--samples", 64))
    here.render.resolution_x = here.render.resolution_y = int(argument("--size", 256))
    picture = argument("--render", "")
    if picture:
        here.render.image_settings.file_format = "OPEN_EXR" if picture.endswith(".exr") else "PNG"
        here.render.filepath = picture
        bpy.ops.render.render(write_still=True)
)",
                {{"comments", commented(m.comments, "# ")},
                 {"base", triple(m.colour(base_color), ", ")},
                 {"metallic", real(m.shared(metallic))},
                 {"specular", real(m.shared(specular))},
                 {"roughness", real(m.shared(roughness))},
                 {"anisotropic", real(std::abs(m.shared(anisotropic)))},
                 {"rotation", m.shared(anisotropic) < 0 ? "0.25" : "0.0"}});
}

}  // namespace

RenderTarget blender_target() {
  return {"blender",
          "Blender 3.4 Python program with a Principled BSDF",
          ".py",
          {{{"Principled BSDF",
             "Blender 3.4, intern/cycles/kernel/closure/bsdf_microfacet.h, bsdf_principled_diffuse.h and svm/closure.h",
             "alpha = Roughness²",
             "Smith, product of both directions",
             "from 0.08 Specular, or from the base colour of a metal, to 1 as the exact Fresnel reflectance of that index rises",
             slots(),
             prepare,
             starts,
             {"one base colour is both the diffuse colour and the metal's reflectance; a dielectric reflects at most 0.08 at the normal"}},
            text}},
          {"Blender has no measured material: these are parameters of its Principled BSDF only",
           "the formula is that of Blender 3.4; from 3.5 the shadowing, and from 4.0 the whole node, are others"}};
}

}  // namespace gonio::tabulated::targets
