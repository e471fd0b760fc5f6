# SPDX-License-Identifier: BSD-3-Clause
"""MaterialX's own GLSL functions, run, give our materials the error that gonio prints."""

import math
import os
import pathlib
import random
import re

import interop

# Composed as libraries/bxdf says for a surface of one dielectric or metal: coat, sheen, transmission and the rest are off.
SURFACE = """
#include <cstdio>
int main() {
  vec3 base_color, specular_color, L, V;
  double metalness, roughness, ior, anisotropy;
  const auto colour = [](vec3& c) { return std::scanf("%lf %lf %lf", &c.x, &c.y, &c.z) == 3; };
  if (!colour(base_color) || !colour(specular_color)) return 1;
  if (std::scanf("%lf %lf %lf %lf", &metalness, &roughness, &ior, &anisotropy) != 4) return 1;
  const vec3 N(0, 0, 1), X(1, 0, 0);
  while (colour(L) && colour(V)) {
    const ClosureData data{CLOSURE_TYPE_REFLECTION, L, V, N, vec3(0.0), 1.0};
    vec2 alpha;
    ROUGHNESS
    const BSDF none{vec3(0.0), vec3(1.0)};
    BSDF diffuse = none, specular = none, metal = none, layered = none;
    DIFFUSE
    mx_dielectric_bsdf(data, 1.0, specular_color, ior, alpha, false, 0.0, 0.0, N, X, 0, 0, specular);
    mx_layer_bsdf(data, specular, diffuse, layered);
    METAL
    const vec3 f = mix(layered.response, metal.response, metalness) / dot(N, L);
    std::printf("%.17g %.17g %.17g\\n", f.x, f.y, f.z);
  }
}
"""
STANDARD = {
    "ROUGHNESS": "mx_roughness_anisotropy(roughness, anisotropy, alpha);",
    "DIFFUSE": "mx_oren_nayar_diffuse_bsdf(data, 1.0, base_color, 0.0, N, false, diffuse);",
    "METAL": "vec3 n, k; mx_artistic_ior(base_color, specular_color, n, k);"
    "mx_conductor_bsdf(data, 1.0, n, k, alpha, false, 0.0, 0.0, N, X, 0, metal);",
}
OPEN_PBR = {
    "ROUGHNESS": "alpha.x = roughness * roughness * sqrt(2 / ((1 - anisotropy) * (1 - anisotropy) + 1)); alpha.y = (1 - anisotropy) * alpha.x;",
    "DIFFUSE": "mx_oren_nayar_diffuse_bsdf(data, 1.0, base_color, 0.0, N, true, diffuse);",
    "METAL": "mx_generalized_schlick_bsdf(data, 1.0, base_color, specular_color, vec3(1.0), 5.0, alpha, false, 0.0, 0.0, N, X, 0, 0, metal);",
}
NAMES = ["base_color", "specular_color", r"(?:base_)?metalness", "specular_roughness", "specular_(?:IOR|ior)", r"specular_(?:roughness_)?anisotropy"]
FILES = ["lib/mx_microfacet.glsl", "lib/mx_microfacet_diffuse.glsl", "lib/mx_microfacet_specular.glsl", "mx_layer_bsdf.glsl", "mx_roughness_anisotropy.glsl",
         "mx_artistic_ior.glsl", "mx_oren_nayar_diffuse_bsdf.glsl", "mx_dielectric_bsdf.glsl", "mx_conductor_bsdf.glsl", "mx_generalized_schlick_bsdf.glsl"]
# Functions of textures, environments and sampling: none is reached by the light of one direction.
ELSEWHERE = re.compile(r"\bmat[34]\b|texture|sampler|\$|Xi\b|spherical_fibonacci|exp\(|mx_(?:sin|cos|atan)|\brefract\(|fract\(|fwidth|monte_carlo|latlong")


class MaterialXValues(interop.TestCase):
    def functions(self, text):
        """Constants, structures and functions of a GLSL file as C++, in their order; without those of ELSEWHERE."""
        text = re.sub(r"//[^\n]*|#include[^\n]*", "", text)
        parts = re.findall(r"^(?:#define [^\n]*|const [^\n]*|struct \w+\s*\{.*?^\};|\w+ \w+\([^)]*\)\s*\{.*?^\})", text, re.S | re.M)
        kept = []
        for part in parts:
            part = re.sub(r"#if DIRECTIONAL_ALBEDO_METHOD == 0(.*?)#elif.*?#endif", r"\1", part, flags=re.S)
            part = re.sub(r"closureData\.closureType == CLOSURE_TYPE_(?:TRANSMISSION|INDIRECT)\)\s*\{.*?^    \}", "false) {}", part, flags=re.S | re.M)
            if not ELSEWHERE.search(part):
                part = re.sub(r"\b(\w+)\.(x|z)(y|w)\b", r"vec2(\1.\2, \1.\3)", part)
                kept.append(re.sub(r"\b(?:inout|out) (\w+) ", r"\1& ", part))
        return "\n".join(kept)

    def program(self, surface):
        """The compiled surface."""
        package = pathlib.Path(interop.module("MaterialX").__file__).parent
        library = package / "libraries" / "pbrlib" / "genglsl"
        source = f'#include "{pathlib.Path(__file__).parent / "glsl_vectors.hpp"}"\n'
        source += "struct BSDF { vec3 response, throughput; };\n#define M_FLOAT_EPS 1e-8\n"
        source += "struct ClosureData { int closureType; vec3 L, V, N, P; double occlusion; };\n"
        source += "#define CLOSURE_TYPE_REFLECTION 1\n#define CLOSURE_TYPE_TRANSMISSION 2\n#define CLOSURE_TYPE_INDIRECT 3\n"
        source += "inline double mx_square(double x) { return x * x; }\ninline vec3 mx_square(vec3 x) { return x * x; }\n"
        source += "inline double mx_acos(double x) { return std::acos(x); }\n"
        body = [self.functions((library / name).read_text()) for name in FILES]
        # Thin films are off: the one function of theirs that is named stays empty.
        body[2] = body[2].replace("vec3 mx_compute_fresnel", "vec3 mx_fresnel_airy(double, FresnelData) { return vec3(0.0); }\nvec3 mx_compute_fresnel", 1)
        main = SURFACE
        for word, text in surface.items():
            main = main.replace(word + "\n", text + "\n")
        file, out = self.folder / "surface.cpp", self.folder / "surface"
        file.write_text(source + "\n".join(body) + main)
        interop.run(os.environ.get("CXX", interop.program("c++")), "-std=c++20", "-w", "-O1", "-o", out, file)
        return out

    def pairs(self):
        choice = random.Random(20260701)
        lowest = math.cos(math.radians(80))
        for _ in range(2000):
            out = []
            for _ in range(2):
                theta, phi = math.acos(choice.uniform(lowest, 1)), choice.uniform(-math.pi, math.pi)
                out.append((theta, phi))
            yield out

    def check_surface(self, target, surface, **parameters):
        fit, file = self.fit("ggx", **parameters), self.folder / "material.mtlx"
        notes = interop.load_json(interop.gonio("export", fit, "--to", target, "--out", file, "--json"))["notes"]
        printed = float(re.search(r"mean relative ([0-9.]+) %", notes["facts"]["after the refit"]).group(1)) / 100
        values = [re.search(rf'name="{name}" [^>]*value="([^"]+)"', file.read_text()).group(1).replace(",", " ") for name in NAMES]
        pairs = list(self.pairs())
        vector = lambda a: (math.sin(a[0]) * math.cos(a[1]), math.sin(a[0]) * math.sin(a[1]), math.cos(a[0]))
        lines = "\n".join(" ".join(repr(x) for a in pair for x in vector(a)) for pair in pairs)
        theirs = [float(line.split()[0]) for line in interop.run(self.program(surface), stdin=" ".join(values) + "\n" + lines).splitlines()]
        self.check(len(theirs) == len(pairs), "a value for every pair")
        ours = interop.evaluate(fit, [tuple(math.degrees(x) for a in pair for x in a) for pair in pairs])
        error = weight = 0
        for (light, viewer), value, (wanted,) in zip(pairs, theirs, ours):
            w, c = math.cos(light[0]) * math.cos(viewer[0]), math.cos(viewer[0])
            error += w * abs(value - wanted) * c / (wanted * c + 1e-3)
            weight += w
        error /= weight
        # The pairs are others than those of the refit.
        self.check(0.9 * printed <= error <= 1.1 * printed, f"{target}: mean relative error of MaterialX's functions {error!r}, printed {printed!r}")

    def test_standard_surface_plastic(self):
        self.check_surface("materialx-standard-surface", STANDARD, rho_d=0.2, f0=0.04, f90=1, alpha=0.2)

    def test_standard_surface_metal(self):
        self.check_surface("materialx-standard-surface", STANDARD, rho_d=0.01, f0=0.8, f90=1, alpha=0.3)

    def test_open_pbr_plastic(self):
        self.check_surface("openpbr", OPEN_PBR, rho_d=0.2, f0=0.04, f90=1, alpha=0.2)

    def test_open_pbr_metal(self):
        self.check_surface("openpbr", OPEN_PBR, rho_d=0.01, f0=0.8, f90=1, alpha=0.3)


interop.main()
